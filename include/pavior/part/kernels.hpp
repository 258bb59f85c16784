#pragma once
/// \file
/// What mesh_part() needs besides the model: the machines of others, in one bundle.

#include <pavior/dual/features.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/plane_arrangement.hpp>
#include <pavior/many_to_many/plane_region.hpp>
#include <pavior/mesh/tagged_mesh.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>

#include <concepts>
#include <string>
#include <utility>

namespace pavior {

/// Tetrahedra to block, and the surface that they fill.
struct BlockReference {
    ReferenceMesh mesh;
    TaggedSurface surface;  ///< tags of its triangles are those of the faces of the model, where it has tags
    bool cad = false;       ///< the surface is that of a CAD model
    double read_seconds = 0, tetra_seconds = 0;
};

/// Makes the tetrahedra of one solid: make(solid, size, features) is a BlockReference. Triangles lie as close to curved
/// faces as hexahedra of \p size need it; feature angles are \p features.
template <class M>
concept reference_mesher = requires(M& make, SolidId solid, double size, const FeatureOptions& features) {
    { make(solid, size, features) } -> std::convertible_to<BlockReference>;
};

/// Says nothing about the methods' own reports.
struct NoDescription {
    template <class... Report>
    void operator()(std::string& /*text*/, const Report&... /*reports*/) const {}
};

/// The callables that mesh a model: pavior::part has them for CAD files. All are called one at a time.
template <plane_imprinter Imprint, integer_solver Solver, region_mesher Regions, cap_mesher Caps,
          reference_mesher Reference, class Describe = NoDescription>
struct Kernels {
    Imprint imprint;      ///< curves in a plane, cut by each other
    Solver solver;        ///< of integer programs
    Regions regions;      ///< quads of plane regions
    Caps caps;            ///< quads of faces
    Reference reference;  ///< tetrahedra of a solid
    /// describe(text, reports...) may add what it makes of a method's own reports to MethodTry::report.
    Describe describe = {};
};

template <class I, class S, class R, class C, class T>
Kernels(I, S, R, C, T) -> Kernels<I, S, R, C, T>;
template <class I, class S, class R, class C, class T, class D>
Kernels(I, S, R, C, T, D) -> Kernels<I, S, R, C, T, D>;

}  // namespace pavior
