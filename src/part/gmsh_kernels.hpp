#pragma once
// The bundle of kernels for CAD models: Gmsh, GLPK, TetGen, CGAL, each behind its component.

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/part/kernels.hpp>

#include <limits>
#include <string>

namespace pavior::detail {

/// Adds the reports of methods to the text of a JSON object.
void describe(std::string& text, const AnyModel& model, const MethodReport& report);

/// Tetrahedra of a solid of a model in memory.
struct GmshReferenceMesher {
    const GmshBrep* model;
    double longest = std::numeric_limits<double>::infinity();  ///< TriangulationOptions::longest
    int per_turn = 16;                                         ///< and per_turn

    [[nodiscard]] BlockReference operator()(SolidId solid, double size, const FeatureOptions& features) const;
};

/// The kernels for \p model, which must outlive them.
[[nodiscard]] Kernels gmsh_kernels(const GmshBrep& model);

}  // namespace pavior::detail
