#pragma once
/// \file
/// Closed surfaces to tetrahedra. Compiled component `tetra`; TetGen (AGPL) and CGAL (GPL) stay inside it.

#include <pavior/mesh/tagged_mesh.hpp>

#include <cstdint>
#include <span>
#include <stop_token>

namespace pavior {

/// Who makes the tetrahedra.
enum class TetEngine : std::uint8_t {
    /// TetGen: keeps the triangles of the surface, or splits them for quality.
    tetgen,
    /// CGAL's Delaunay refinement (Mesh_3): samples the surface anew, and so needs keep_surface = false. Kept exactly
    /// are tagged vertices, and as unions of new edges the tagged edges and those between two tags or sharper than 45
    /// degrees (10 where that works out); elsewhere the surface is met within 2 % of the edge length. That is the one
    /// of max_volume, or a tenth of the diagonal of the surface. No inner facets. Nodes come in an order of their own.
    cgal,
};

/// How tetrahedralize() works.
struct TetOptions {
    TetEngine engine = TetEngine::tetgen;
    /// Largest radius-edge ratio, at least 1; 0 (default): no quality asked for, the coarsest mesh.
    double quality = 0.0;
    /// Largest volume of a tetrahedron; 0 (default): no limit.
    double max_volume = 0.0;
    /// Keep the surface triangles as they are. Then quality and max_volume are goals for the inside only: a large
    /// triangle keeps nodes away, and has a large tetrahedron behind it. Otherwise triangles and edges may be split,
    /// and plane regions of one tag are triangulated anew.
    bool keep_surface = true;
    /// Seconds that one run of the engine may take; 0: no limit. It is stopped then, whatever it does.
    double time_limit = 600.0;
    std::stop_token stop = {};  ///< ends the call by Stopped
};

/// Fills \p surface, whose triangles close one or several shells (cavities and solids within them included), with
/// tetrahedra.
///
/// By default the mesh is the coarsest one that TetGen finds and has every triangle of the surface as it is; nodes are
/// added only where no mesh without them is found, and then inside. Nodes of the surface come first in their order,
/// added ones after them. Tetrahedra are positive, none is flat without need (altitude by longest edge
/// above 1e-6 where TetGen finds such a mesh, always above 1e-12); `triangles` are the boundary, outward,
/// in the order of the surface (pieces of split triangles in the order of what they are pieces of). Triangles and edges
/// have the tags of what they lie on, `vertices` are those of the surface. The result is checked before it is returned:
/// signs (exactly), conformity, boundary, volume, lengths of tagged edges.
///
/// The engine runs in a child process (fork), which gets its own copy of the memory, prints nothing and cannot end this
/// one: TetGen 1.5 has assertions that fail on good input. Where a run fails or leaves flat tetrahedra, others with
/// other tolerances and orders of insertion follow; where TetGen cannot split the surface, it is split before.
///
/// Thread-safe; deterministic. About 10 microseconds and 350 bytes a tetrahedron, both processes together.
/// \throws InputError what check_surface() finds, naming triangles; bad_index for tagged edges that are no edges of
///         triangles and tagged vertices that are no nodes, naming them; size_mismatch (face_tags); bad_option;
///         tetrahedra_failed with what the engine said to each attempt, or that time was over; Stopped
[[nodiscard]] TaggedTetMesh tetrahedralize(const TaggedSurface& surface, const TetOptions& options = {});

/// The same with inner facets: triangles on nodes of \p surface (which may lie inside) that become faces with
/// tetrahedra on both sides, and keep their tags and orientation. They follow the boundary in `triangles`. In what
/// check_surface() finds, inner facet i is triangle i + number of triangles of the surface; inconsistent_boundary with
/// the number of an inner facet that lies outside.
[[nodiscard]] TaggedTetMesh tetrahedralize(const TaggedSurface& surface, std::span<const TaggedTriangle> inner_facets,
                                           const TetOptions& options = {});

}  // namespace pavior
