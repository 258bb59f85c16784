#include "gmsh_kernels.hpp"

#include "../report/report_json.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/cut_model.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/cad/tetrahedra.hpp>
#include <pavior/decompose/cut_lines.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/decompose_solids.hpp>

#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace pavior::detail {

namespace {

nlohmann::json described(const AnyModel& /*model*/, const BlockedModel& blocked) {
    return to_json(blocked.reference, blocked.blocks);
}
nlohmann::json described(const AnyModel& /*model*/, const SmoothReport& report) {
    return {{"improvement", to_json(report)}};
}
nlohmann::json described(const AnyModel& /*model*/, const JudgedMesh& judged) {
    return {{"mesh", to_json(*judged.data, judged.check)},
            {"cad_volume", judged.deviation.cad_volume.value_or(0)},
            {"deviation", to_json(judged.deviation)}};
}
template <class Report>
nlohmann::json described(const AnyModel& model, const Report& report) {
    return to_json(model, report);
}

/// GmshCutter, made at the first cut, behind one type.
class AnyCutter {
public:
    explicit AnyCutter(const GmshBrep& model) : model_(&model) {}

    std::optional<ModelPieces> operator()(std::span<const SolidCut> cuts) {
        if (!cutter_) {
            cutter_ = std::make_shared<const GmshCutter>(*model_);
        }
        std::optional<GmshPieces> made = (*cutter_)(cuts);
        if (!made) {
            return std::nullopt;
        }
        struct Kept {
            GmshPieces pieces;
            AnyModel any;
        };
        const GmshBrep& brep = *made->model;
        const auto kept = std::make_shared<Kept>(Kept{std::move(*made), AnyModel(brep)});
        return ModelPieces{std::shared_ptr<const AnyModel>(kept, &kept->any), kept->pieces.solid, GmshCapMesher{&brep},
                           [cutter = cutter_, kept] { return cutter->identify(kept->pieces); },
                           edges_on_curves(brep, cuts)};
    }

private:
    const GmshBrep* model_;
    std::shared_ptr<const GmshCutter> cutter_;
};

}  // namespace

void describe(std::string& text, const AnyModel& model, const MethodReport& report) {
    nlohmann::json json = text.empty() ? nlohmann::json::object() : nlohmann::json::parse(text);
    std::visit([&](const auto* own) { json.update(described(model, *own)); }, report);
    text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Kernels gmsh_kernels(const GmshBrep& model) {
    return {
        imprint,
        GlpkSolver{{10, {}}},
        GmshRegionMesher{},
        GmshCapMesher{&model},
        GmshReferenceMesher{&model},
        describe,
        [&model](std::span<const SolidId> solids, const TetSizes& sizes) {
            return tetrahedra_of(model, solids, sizes);
        },
        AnyCutter{model},
        {GmshReferenceMesher{&model, 1, 16}, GmshReferenceMesher{&model, 1, 20}, GmshReferenceMesher{&model, 1, 12}}};
}

}  // namespace pavior::detail
