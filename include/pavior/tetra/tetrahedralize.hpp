#pragma once
/// \file
/// Closed surfaces to tetrahedra. Compiled component `tetra`; TetGen (AGPL) and CGAL (GPL) stay inside it.

#include <pavior/mesh/tagged_mesh.hpp>

#include <cstdint>
#include <span>

namespace pavior {

/// Who makes the tetrahedra.
enum class TetEngine : std::uint8_t {
    tetgen,  ///< TetGen: constrained Delaunay, keeps the surface triangles (subdivides them only for quality)
    cgal,    ///< CGAL
};

/// How tetrahedralize() works.
struct TetOptions {
    TetEngine engine = TetEngine::tetgen;
    /// Largest radius-edge ratio, at least 1; 0 (default): no quality asked for, the coarsest mesh.
    double quality = 0.0;
    /// Largest volume of a tetrahedron; 0 (default): no limit.
    double max_volume = 0.0;
    /// Keep the surface triangles as they are, also where quality would split them.
    bool keep_surface = true;
    /// Seconds that one run of the engine may take; 0: no limit.
    double time_limit = 600.0;
};

/// Fills \p surface, whose triangles close one or several shells (cavities included), with tetrahedra.
/// Nodes of the surface come first in their order; tags of triangles, edges and vertices are kept (those of split
/// triangles and edges are inherited). Tetrahedra are positive; boundary triangles point outwards.
/// \throws InputError naming triangles (not_finite, bad_index, non_manifold, open_surface, bad_orientation,
///         self_intersection, degenerate_triangle) or tetrahedra_failed. Never ends the process.
[[nodiscard]] TaggedTetMesh tetrahedralize(const TaggedSurface& surface, const TetOptions& options = {});

/// The same with inner facets: triangles on nodes of \p surface (which may lie inside) that become faces with
/// tetrahedra on both sides, and keep their tags and orientation. They follow the boundary in `triangles`.
[[nodiscard]] TaggedTetMesh tetrahedralize(const TaggedSurface& surface, std::span<const TaggedTriangle> inner_facets,
                                           const TetOptions& options = {});

}  // namespace pavior
