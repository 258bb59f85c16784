#include "grouped.hpp"
#include "mesh_methods.hpp"
#include "swept.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/model/integer_program.hpp>
#include <pavior/model/multi_sweep_model.hpp>

#include <sstream>

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

std::string note_of(const MultiSweepAttempt& attempt) {
    std::ostringstream text;
    const Vec3 d = attempt.direction + Vec3::Zero();  // no -0
    text << "along (" << d[0] << ", " << d[1] << ", " << d[2] << "), merging within " << attempt.merge
         << " sizes, chords within " << attempt.chord << ": "
         << (attempt.error.empty() ? "least scaled Jacobian " : attempt.error);
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
    const auto solver = [](const IntegerProgram& program) { return solve(program, {10, 1e-3}); };
    BestMultiSweep best = best_multi_sweep(model, solids, options, imprint, solver, GmshRegionMesher{}, out_of_time);
    result.details["attempts"] = Json::array();
    for (const MultiSweepAttempt& attempt : best.attempts) {
        const Vec3 d = attempt.direction + Vec3::Zero();  // no -0
        Json json{{"direction", {d[0], d[1], d[2]}}, {"merge", attempt.merge}, {"chord", attempt.chord}};
        json["scaled_jacobian"] = attempt.error.empty() ? Json(attempt.quality) : Json();
        json["face_distance"] = attempt.error.empty() ? Json(attempt.face_distance) : Json();
        json["error"] = attempt.error;
        json["faces"] = attempt.tags;
        result.details["attempts"].push_back(std::move(json));
        result.notes.push_back(note_of(attempt));
    }
    if (!best.mesh) {
        throw no_mesh_error(best);
    }
    result.details["direction"] = {best.mesh->direction[0], best.mesh->direction[1], best.mesh->direction[2]};
    result.details["report"] = to_json(best.mesh->report);
    result.data = grouped(model, solids, *best.mesh);
}

}  // namespace pavior::cli
