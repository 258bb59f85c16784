#pragma once
// The bundle of kernels for CAD models: Gmsh, GLPK, TetGen, CGAL, each behind its component.

#include "../report/report_json.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/kernels.hpp>

#include <optional>
#include <string>

namespace pavior::detail {

/// Adds the reports of methods to the text of a JSON object.
struct JsonDescription {
    template <class Report>
    void operator()(std::string& text, const GmshBrep& model, const Report& report) const {
        add(text, to_json(model, report));
    }
    void operator()(std::string& text, const GmshBrep& /*model*/, const BlockedModel& model) const {
        add(text, to_json(model.reference, model.blocks));
    }
    void operator()(std::string& text, const SmoothReport& report) const {
        add(text, {{"improvement", to_json(report)}});
    }
    void operator()(std::string& text, const HexMeshData& data, const MeshCheck& check,
                    std::optional<double> volume) const {
        add(text, {{"mesh", to_json(data, check)}, {"cad_volume", volume.value_or(0)}});
    }

private:
    static void add(std::string& text, const nlohmann::json& more) {
        nlohmann::json json = text.empty() ? nlohmann::json::object() : nlohmann::json::parse(text);
        json.update(more);
        text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
};

/// Tetrahedra of a solid of a model in memory.
struct GmshReferenceMesher {
    const GmshBrep* model;

    [[nodiscard]] BlockReference operator()(SolidId solid, double size, const FeatureOptions& features) const;
};

/// The kernels for \p model, which must outlive them.
[[nodiscard]] inline auto gmsh_kernels(const GmshBrep& model) {
    return Kernels{
        imprint,          GlpkSolver{{10, {}}}, GmshRegionMesher{}, GmshCapMesher{&model}, GmshReferenceMesher{&model},
        JsonDescription{}};
}

}  // namespace pavior::detail
