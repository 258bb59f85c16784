#include "mesh_methods.hpp"
#include "../common/child_process.hpp"
#include "check.hpp"
#include "grouped.hpp"
#include "mesh_bytes.hpp"
#include "swept.hpp"

#include <pavior/brep/chord_volume.hpp>
#include <pavior/core/stopwatch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iomanip>
#include <map>
#include <new>
#include <sstream>
#include <vector>

namespace pavior::cli {

using Json = nlohmann::json;
using Outcome = MethodTry::Outcome;

void try_sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    SweepCommand own;
    own.size = mesh_size(model, command);
    own.threads = command.threads;
    Swept swept = sweep_cad_model(model, solids, own, {});
    result.data = std::move(swept.data);
    result.details = std::move(swept.report);
    result.warnings = std::move(swept.warnings);
    for (const Json& solid : result.details["solids"]) {
        std::ostringstream note;
        note << "from face " << solid["source"] << " to face " << solid["target"] << " in " << solid["layers"]
             << " layers";
        result.notes.push_back(note.str());
    }
}

namespace {

/// True if the volumes agree to 1e-6, or differ by no more than lies between the quads and the curved faces.
bool same_volume(const GmshBrep& model, const HexMeshData& data, double volume, double cad_volume) {
    const double error = std::abs(volume - cad_volume) - 1e-6 * cad_volume;
    if (error <= 0) {
        return true;
    }
    std::map<int, FaceId> curved;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(model.face_count()); ++f) {
        if (model.face_kind(FaceId{f}) != "Plane") {
            curved.emplace(model.tag(2, FaceId{f}.index()), FaceId{f});
        }
    }
    std::vector<QuadCorners> quads;
    std::vector<FaceId> faces;
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (const auto found = curved.find(data.quad_groups[q]); found != curved.end()) {
            quads.push_back(data.quads[q]);
            faces.push_back(found->second);
        }
    }
    return chord_volume(model, data.mesh.nodes, quads, faces, error) >= error;
}

/// Whether the mesh is one: conforming, not inverted, and as large as the solids.
void judge(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    const MeshCheck check = check_mesh(result.data, Execution{command.threads});
    double volume = 0;
    for (const SolidId solid : solids) {
        volume += model.solid_volume(solid);
    }
    const bool complete = same_volume(model, result.data, check.verify.volume, volume);
    result.hexahedra = check.hexahedra;
    result.min_jacobian = check.quality.scaled_jacobian.min;
    result.details["mesh"] = cli::to_json(result.data, check);
    result.details["cad_volume"] = volume;
    const bool flat = !(result.min_jacobian > 1e-6);
    result.outcome = check.valid() && complete && !flat ? Outcome::mesh : Outcome::invalid;
    std::ostringstream reason;
    if (!check.verify.ok()) {
        reason << check.verify.text();
    } else if (check.quality.inverted > 0) {
        reason << check.quality.inverted << " inverted hexahedra";
    } else if (flat) {
        reason << "hexahedra are flat, the least scaled Jacobian is " << result.min_jacobian;
    } else if (!complete) {
        reason << "its volume is " << check.verify.volume << ", that of the CAD model " << volume;
    }
    result.reason = reason.str();
}

void refuse(MethodTry& result, const Error& error) {
    result.outcome = Outcome::refused;
    result.reason = error.what();
    const ErrorCode code = error.code();
    if (code == ErrorCode::not_sweepable || code == ErrorCode::not_submappable || code == ErrorCode::cad_failure) {
        result.faces.assign(error.ids().begin(), error.ids().end());
        std::sort(result.faces.begin(), result.faces.end());
        result.faces.erase(std::unique(result.faces.begin(), result.faces.end()), result.faces.end());
    }
}

}  // namespace

std::string_view to_string(MeshMethod method) {
    switch (method) {
        case MeshMethod::submap: return "submap";
        case MeshMethod::sweep: return "sweep";
        case MeshMethod::multi_sweep: return "multi-sweep";
        case MeshMethod::mixed: return "mixed";
        case MeshMethod::block: return "block";
    }
    return "unknown";
}

std::string_view to_string(MethodTry::Outcome outcome) {
    switch (outcome) {
        case Outcome::mesh: return "mesh";
        case Outcome::invalid: return "invalid";
        case Outcome::refused: return "refused";
        case Outcome::timed_out: return "timed_out";
        case Outcome::died: return "died";
        case Outcome::not_tried: return "not_tried";
    }
    return "unknown";
}

MethodTry try_method(MeshMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                     const MeshCommand& command, const std::function<bool()>& out_of_time) {
    MethodTry result;
    result.method = method;
    const Stopwatch watch;
    try {
        switch (method) {
            case MeshMethod::submap: try_submap(model, solids, command, result); break;
            case MeshMethod::sweep: try_sweep(model, solids, command, result); break;
            case MeshMethod::multi_sweep: try_multi_sweep(model, solids, command, out_of_time, result); break;
            case MeshMethod::mixed: try_mixed(model, solids, command, out_of_time, result); break;
            case MeshMethod::block: try_block(model, solids, command, result); break;
        }
        if (!out_of_time()) {
            improve_poor_mesh(model, command, result);
        }
        judge(model, solids, command, result);
    } catch (const Error& error) {
        refuse(result, error);
    } catch (const std::bad_alloc&) {
        result.outcome = Outcome::died;
        result.reason = "not enough memory";
    } catch (const std::exception& error) {
        result.outcome = Outcome::died;
        result.reason = error.what();
    }
    result.seconds = watch.total();
    return result;
}

MethodTry try_method_in_child(MeshMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                              const MeshCommand& command, double seconds) {
    const Stopwatch watch;
    const auto late = [&] { return seconds > 0 && watch.total() > 0.7 * seconds; };
    using End = detail::ChildAnswer::End;
    const detail::ChildAnswer answer =
        detail::run_in_child([&] { return to_bytes(try_method(method, model, solids, command, late)); }, seconds);
    MethodTry result;
    if (answer.end == End::answered) {
        result = try_from_bytes(answer.bytes);
    } else {
        std::ostringstream reason;
        const bool late_answer = answer.end == End::timed_out;
        result.outcome = late_answer ? Outcome::timed_out : Outcome::died;
        if (late_answer) {
            reason << std::setprecision(3) << "not done after " << seconds << " s";
        } else {
            reason << "it " << answer.reason;
        }
        result.reason = reason.str();
        result.method = method;
    }
    result.seconds = watch.total();
    return result;
}

}  // namespace pavior::cli
