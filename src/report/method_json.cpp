#include "report_json.hpp"

#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/decompose_solids.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/split_solids.hpp>
#include <pavior/part/sweep_solids.hpp>
#include <pavior/submap/submap_model.hpp>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace pavior::detail {

using Json = nlohmann::json;

Json to_json(const SweepReport& report) {
    Json json{{"layers", report.layers},
              {"loops", report.loops},
              {"loop_nodes", report.loop_nodes},
              {"seconds", report.verify_seconds + report.fit_seconds + report.prepare_seconds + report.nodes_seconds}};
    double worst = 0;
    for (const LevelResidual& residual : report.residuals) {
        worst = std::max(worst, residual.max);
    }
    json["max_residual"] = worst;
    json["warnings"] = Json::array();
    for (const SweepWarning& warning : report.warnings) {
        json["warnings"].push_back({{"notice", to_string(warning.notice)}, {"ids", warning.ids}});
    }
    return json;
}

Json to_json(const SmoothReport& report) {
    return {{"status", to_string(report.status)},
            {"inverted_before", report.inverted_before},
            {"inverted_after", report.inverted_after},
            {"inverted_ids", report.inverted_ids},
            {"moved_nodes", report.moved_nodes}};
}

Json to_json(const AnyModel& model, const SweptSolids& swept) {
    const ModelMesh& result = swept.mesh;
    const IntervalAssignment& intervals = swept.intervals;
    Json json;
    json["intervals"] = {{"mean_ratio", intervals.mean_ratio},
                         {"worst_ratio", intervals.worst_ratio},
                         {"optimal", intervals.optimal},
                         {"angles_kept", intervals.angles_kept}};
    json["solids"] = Json::array();
    for (const SolidReport& solid : result.solids) {
        Json entry{{"solid", model.tag(3, solid.solid.index())},
                   {"name", model.solid_name(solid.solid)},
                   {"source", model.tag(2, solid.source.index())},
                   {"target", model.tag(2, solid.target.index())},
                   {"layers", solid.layers},
                   {"first_hex", solid.first_hex},
                   {"hexahedra", solid.hex_count},
                   {"cad_volume", model.solid_volume(solid.solid).value_or(0)},
                   {"sweep", to_json(solid.sweep)},
                   {"smooth", to_json(solid.smooth)}};
        if (solid.target_projection) {
            const TargetReport& target = *solid.target_projection;
            entry["target_projection"] = {{"residual", target.residual},
                                          {"corrected", target.corrected},
                                          {"folded_by_map", target.folded_by_map},
                                          {"folded", target.folded},
                                          {"smooth", to_json(target.smooth)}};
        }
        json["solids"].push_back(std::move(entry));
    }
    json["linking_sides"] = Json::array();
    for (const LinkingFaceReport& side : result.sides) {
        json["linking_sides"].push_back({{"face", model.tag(2, side.face.index())},
                                         {"way", to_string(side.way)},
                                         {"folded_by_interpolation", side.folded_parameter},
                                         {"folded", side.folded}});
    }
    return json;
}

Json to_json(const AnyModel& model, const SubmappedMesh& mesh) {
    Json json{{"solids", Json::array()}};
    for (const SubmapSolidReport& solid : mesh.solids) {
        json["solids"].push_back({{"solid", model.tag(3, solid.solid.index())},
                                  {"hexahedra", solid.hex_count},
                                  {"low", solid.low},
                                  {"high", solid.high},
                                  {"deviation_degrees", solid.deviation},
                                  {"smooth", to_json(solid.smooth)}});
    }
    return json;
}

Json to_json(const AnyModel& model, const MixedSolids& mesh) {
    Json json{{"solids", Json::array()}};
    for (const auto& [solid, method] : mesh.methods) {
        json["solids"].push_back({{"solid", model.tag(3, solid.index())}, {"method", to_string(method)}});
    }
    return json;
}

Json to_json(const AnyModel& /*model*/, const SplitSolids& mesh) {
    Json json{{"last_resort", true},
              {"taken", mesh.taken},
              {"out_of_time", mesh.out_of_time},
              {"limit", mesh.limit},
              {"attempts", Json::array()}};
    for (const SplitAttempt& attempt : mesh.attempts) {
        const bool made = attempt.error.empty();
        json["attempts"].push_back({{"size", attempt.sizes.size},
                                    {"least_size", attempt.sizes.least},
                                    {"per_turn", attempt.sizes.per_turn},
                                    {"variant", attempt.sizes.variant},
                                    {"tetrahedra", attempt.tets},
                                    {"scaled_jacobian_as_split", made ? Json(attempt.split_jacobian) : Json()},
                                    {"scaled_jacobian", made ? Json(attempt.min_jacobian) : Json()},
                                    {"nodes_off", attempt.off},
                                    {"error", attempt.error}});
    }
    return json;
}

namespace {

Json array_of(const Vec3& x) { return {x[0], x[1], x[2]}; }

struct SurfaceJson {
    Json operator()(const CutPlane& s) const {
        return {{"kind", "plane"}, {"point", array_of(s.point)}, {"normal", array_of(s.normal)}};
    }
    Json operator()(const CutHalfPlane& s) const {
        return {{"kind", "half-plane"},
                {"point", array_of(s.point)},
                {"along", array_of(s.along)},
                {"into", array_of(s.into)}};
    }
    Json operator()(const CutCylinder& s) const {
        return {{"kind", "cylinder"},
                {"point", array_of(s.point)},
                {"direction", array_of(s.direction)},
                {"radius", s.radius},
                {"seam", array_of(s.seam)}};
    }
};

}  // namespace

Json to_json(const SolidCut& cut) {
    Json json{{"solid", cut.solid.value}, {"reason", to_string(cut.reason)}, {"surfaces", Json::array()}};
    for (const CutSurface& surface : cut.surfaces) {
        json["surfaces"].push_back(std::visit(SurfaceJson{}, surface));
    }
    for (const CutCurve& curve : cut.curves) {
        json["curves"].push_back({array_of(curve.from), array_of(curve.middle), array_of(curve.to)});
    }
    return json;
}

Json to_json(const AnyModel& /*model*/, const DecomposedSolids& mesh) {
    Json json{{"cuts", Json::array()},
              {"cuts_tried", mesh.search.tried},
              {"meshes_tried", mesh.search.meshed},
              {"pieces", Json::array()}};
    for (const SolidCut& cut : mesh.search.cuts) {
        json["cuts"].push_back(to_json(cut));
    }
    for (const PieceMethods& piece : mesh.methods) {
        json["pieces"].push_back(
            {{"submap", piece.submap}, {"sweep", piece.sweep}, {"multi_sweep", piece.multi_sweep}});
    }
    return json;
}

namespace {

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
            {"smooth", detail::to_json(report.smooth)}};
}

std::vector<int> tags_of(const AnyModel& model, const EdgeChain& ribs) {
    std::vector<int> tags;
    for (const OrientedEdge& use : ribs) {
        tags.push_back(model.tag(1, use.edge.index()));
    }
    return tags;
}

/// Adds what says where to sweep: a direction, an axis, or edges.
void add_path(const AnyModel& model, Json& json, const SweepPath& path) {
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

}  // namespace

Json to_json(const AnyModel& model, const BestMultiSweep& best) {
    Json json{{"attempts", Json::array()}};
    for (const MultiSweepAttempt& attempt : best.attempts) {
        Json entry{{"merge", attempt.merge}, {"chord", attempt.chord}};
        add_path(model, entry, attempt.path);
        entry["scaled_jacobian"] = attempt.error.empty() ? Json(attempt.quality) : Json();
        entry["face_distance"] = attempt.error.empty() ? Json(attempt.face_distance) : Json();
        entry["error"] = attempt.error;
        entry["faces"] = attempt.tags;
        json["attempts"].push_back(std::move(entry));
    }
    if (best.mesh) {
        add_path(model, json, best.mesh->path);
        json["report"] = to_json(best.mesh->report);
    }
    return json;
}

}  // namespace pavior::detail
