#include "grouped.hpp"
#include "mesh_methods.hpp"
#include "swept.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>

#include <optional>
#include <sstream>
#include <string>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

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

std::string text_of(const Vec3& x) {
    const Vec3 d = x + Vec3::Zero();  // no -0
    std::ostringstream text;
    text << "(" << d[0] << ", " << d[1] << ", " << d[2] << ")";
    return text.str();
}

std::vector<int> tags_of(const GmshBrep& model, const EdgeChain& ribs) {
    std::vector<int> tags;
    for (const OrientedEdge& use : ribs) {
        tags.push_back(model.tag(1, use.edge.index()));
    }
    return tags;
}

/// "along (0, 0, 1)", "round the axis through (1, 2, 3) along (0, 0, 1)" or "parallel to edges 7, 8"
std::string text_of(const GmshBrep& model, const SweepPath& path) {
    if (path.axis) {
        return "round the axis through " + text_of(path.axis->origin) + " along " + text_of(path.axis->direction);
    }
    std::string text;
    for (const int tag : tags_of(model, path.ribs)) {
        text += (text.empty() ? "parallel to edges " : ", ") + std::to_string(tag);
    }
    return text.empty() ? "along " + text_of(path.direction) : text;
}

/// Adds what says where to sweep: a direction, an axis, or edges.
void add_path(const GmshBrep& model, Json& json, const SweepPath& path) {
    const auto list = [](const Vec3& x) {
        const Vec3 d = x + Vec3::Zero();  // no -0
        return Json{d[0], d[1], d[2]};
    };
    const bool straight = !path.axis && path.ribs.empty();
    json["direction"] = straight ? list(path.direction) : Json();
    json["axis"] =
        path.axis ? Json{{"origin", list(path.axis->origin)}, {"direction", list(path.axis->direction)}} : Json();
    json["edges"] = path.ribs.empty() ? Json() : Json(tags_of(model, path.ribs));
}

std::string note_of(const GmshBrep& model, const MultiSweepAttempt& attempt) {
    std::ostringstream text;
    text << text_of(model, attempt.path) << ", merging within " << attempt.merge << " sizes, chords within "
         << attempt.chord << ": " << (attempt.error.empty() ? "least scaled Jacobian " : attempt.error);
    if (attempt.error.empty()) {
        text << attempt.quality << ", boundary nodes within " << attempt.face_distance << " of their faces";
    }
    return text.str();
}

}  // namespace

void try_multi_sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command,
                     const std::function<bool()>& out_of_time, MethodTry& result) {
    MultiSweepOptions options;
    options.size = mesh_size(model, command);
    options.execution = Execution{command.threads};
    BestMultiSweep best =
        best_multi_sweep(model, solids, options, imprint, solve_shortly, GmshRegionMesher{}, out_of_time);
    result.details["attempts"] = Json::array();
    for (const MultiSweepAttempt& attempt : best.attempts) {
        Json json{{"merge", attempt.merge}, {"chord", attempt.chord}};
        add_path(model, json, attempt.path);
        json["scaled_jacobian"] = attempt.error.empty() ? Json(attempt.quality) : Json();
        json["face_distance"] = attempt.error.empty() ? Json(attempt.face_distance) : Json();
        json["error"] = attempt.error;
        json["faces"] = attempt.tags;
        result.details["attempts"].push_back(std::move(json));
        result.notes.push_back(note_of(model, attempt));
    }
    if (!best.mesh) {
        throw no_mesh_error(best);
    }
    add_path(model, result.details, best.mesh->path);
    result.details["report"] = to_json(best.mesh->report);
    result.data = grouped(model, solids, *best.mesh);
}

}  // namespace pavior::cli
