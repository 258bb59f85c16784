#include "blocked.hpp"
#include "check.hpp"
#include "child_task.hpp"
#include "grouped.hpp"
#include "mesh_bytes.hpp"
#include "meshed.hpp"
#include "swept.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/model/integer_program.hpp>
#include <pavior/model/multi_sweep_model.hpp>
#include <pavior/model/submap_model.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <sstream>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;
using Outcome = MethodTry::Outcome;

double size_of(const GmshBrep& model, const MeshCommand& command) {
    return command.size > 0 ? command.size : model.diagonal() / 12;
}

void submap(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    IntervalOptions intervals;
    intervals.size = size_of(model, command);
    SubmappedMesh mesh = submap_model(model, solids, intervals);
    Json& json = result.details;
    json["solids"] = Json::array();
    for (const SubmapSolidReport& solid : mesh.solids) {
        json["solids"].push_back({{"solid", model.tag(3, solid.solid.index())},
                                  {"hexahedra", solid.hex_count},
                                  {"low", solid.low},
                                  {"high", solid.high},
                                  {"deviation_degrees", solid.deviation},
                                  {"smooth", cli::to_json(solid.smooth)}});
        std::ostringstream note;
        note << "box of the lattice " << solid.high[0] - solid.low[0] << " x " << solid.high[1] - solid.low[1] << " x "
             << solid.high[2] - solid.low[2] << ", angles within " << solid.deviation << " degrees of their class";
        result.notes.push_back(note.str());
    }
    result.data = grouped(model, solids, mesh);
}

void sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    SweepCommand own;
    own.size = size_of(model, command);
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

Json to_json(const MultiSweepReport& report) {
    return {{"merge", report.merge},
            {"least_merge", report.least_merge},
            {"cells", report.cells},
            {"mapped_cells", report.mapped_cells},
            {"refined_cells", report.refined_cells},
            {"levels", report.levels},
            {"worst_plane_ratio", report.worst_plane_ratio},
            {"worst_layer_ratio", report.worst_layer_ratio},
            {"optimal", report.optimal},
            {"smooth", cli::to_json(report.smooth)}};
}

std::string note_of(const MultiSweepAttempt& attempt) {
    std::ostringstream text;
    const Vec3 d = attempt.direction;
    text << "along (" << d[0] << ", " << d[1] << ", " << d[2] << "), merging within " << attempt.merge
         << " sizes: " << (attempt.error.empty() ? "least scaled Jacobian " : attempt.error);
    if (attempt.error.empty()) {
        text << attempt.quality;
    }
    return text.str();
}

void multi_sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command,
                 const std::function<bool()>& out_of_time, MethodTry& result) {
    MultiSweepOptions options;
    options.size = size_of(model, command);
    options.execution = Execution{command.threads};
    const auto solver = [](const IntegerProgram& program) { return solve(program, {10, 1e-3}); };
    BestMultiSweep best = best_multi_sweep(model, solids, options, imprint, solver, GmshRegionMesher{}, out_of_time);
    result.details["attempts"] = Json::array();
    for (const MultiSweepAttempt& attempt : best.attempts) {
        const Vec3 d = attempt.direction;
        Json json{{"direction", {d[0], d[1], d[2]}}, {"merge", attempt.merge}};
        json["scaled_jacobian"] = attempt.error.empty() ? Json(attempt.quality) : Json();
        json["error"] = attempt.error;
        json["faces"] = attempt.tags;
        result.details["attempts"].push_back(std::move(json));
        result.notes.push_back(note_of(attempt));
    }
    if (!best.mesh) {
        if (best.attempts.empty()) {
            throw UnmeshableError(ErrorCode::not_sweepable, "no time was left to try a direction");
        }
        const MultiSweepAttempt& first = best.attempts.front();
        const std::size_t colon = first.error.find(": ");
        throw UnmeshableError(ErrorCode::not_sweepable,
                              colon == std::string::npos ? first.error : first.error.substr(colon + 2), first.tags);
    }
    result.details["direction"] = {best.mesh->direction[0], best.mesh->direction[1], best.mesh->direction[2]};
    result.details["report"] = to_json(best.mesh->report);
    result.data = grouped(model, solids, *best.mesh);
}

void block(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    if (model.solid_count() != 1) {
        throw UnmeshableError(ErrorCode::invalid_dual,
                              "blocks are made of one solid, the file has " + std::to_string(model.solid_count()));
    }
    BlockCommand own;
    own.input = command.input;
    own.size = size_of(model, command);
    own.threads = command.threads;
    const BlockInput input = read_block_input(own, {});
    BlockOptions options;
    options.execution = Execution{command.threads};
    options.refine.emplace();
    options.refine->size = own.size;
    const SolidBlocks blocks = block_solid(input.reference, options);
    result.details = cli::to_json(input, blocks);
    if (!blocks.report.dual.valid()) {
        blocks.report.dual.throw_if_invalid();
        throw UnmeshableError(ErrorCode::invalid_dual, "the layers make no blocks");
    }
    result.notes.push_back(std::to_string(blocks.report.blocks.blocks) + " blocks");
    result.data = block_data(input, blocks);
    result.data.hex_groups.assign(result.data.mesh.hexes.size(), model.tag(3, 0));
    result.data.groups = entity_groups(model, solids);
}

/// True if all faces are planes: the volume is exact then.
bool planar(const GmshBrep& model, std::span<const SolidId> solids) {
    return std::all_of(solids.begin(), solids.end(), [&](SolidId solid) {
        const auto faces = model.solid_faces(solid);
        return std::all_of(faces.begin(), faces.end(),
                           [&](const OrientedFace& f) { return model.face_kind(f.face) == "Plane"; });
    });
}

/// Whether the mesh is one: conforming, not inverted, and as large as the solids.
void judge(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    const MeshCheck check = check_mesh(result.data, Execution{command.threads});
    double volume = 0;
    for (const SolidId solid : solids) {
        volume += model.solid_volume(solid);
    }
    const double error = check.verify.volume / volume - 1;
    const bool complete = std::abs(error) < (planar(model, solids) ? 1e-6 : 0.4);
    result.hexahedra = check.hexahedra;
    result.min_jacobian = check.quality.scaled_jacobian.min;
    result.details["mesh"] = cli::to_json(result.data, check);
    result.details["cad_volume"] = volume;
    result.outcome = check.valid() && complete ? Outcome::mesh : Outcome::invalid;
    std::ostringstream reason;
    if (!check.valid()) {
        reason << check.verify.text();
        if (check.quality.inverted > 0) {
            reason << (check.verify.ok() ? "" : "; ") << check.quality.inverted << " inverted hexahedra";
        }
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
            case MeshMethod::submap: submap(model, solids, command, result); break;
            case MeshMethod::sweep: sweep(model, solids, command, result); break;
            case MeshMethod::multi_sweep: multi_sweep(model, solids, command, out_of_time, result); break;
            case MeshMethod::block: block(model, solids, command, result); break;
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
    const ChildAnswer answer =
        run_in_child([&] { return to_bytes(try_method(method, model, solids, command, late)); }, seconds);
    MethodTry result;
    if (answer.end == ChildAnswer::End::answered) {
        result = try_from_bytes(answer.bytes);
    } else {
        std::ostringstream reason;
        const bool late_answer = answer.end == ChildAnswer::End::timed_out;
        result.outcome = late_answer ? Outcome::timed_out : Outcome::died;
        if (late_answer) {
            reason << "not done after " << seconds << " s";
        } else {
            reason << answer.reason;
        }
        result.reason = reason.str();
        result.method = method;
    }
    result.seconds = watch.total();
    return result;
}

}  // namespace pavior::cli
