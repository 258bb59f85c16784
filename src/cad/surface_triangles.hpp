#pragma once
// Triangles of faces, as few as a chord admits: long where a face is straight, short where it bends. Internal to the
// cad component.

#include "gmsh_topology.hpp"

#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace pavior::detail {

/// What triangles must keep to.
struct SurfaceLimits {
    double chord = 0;   ///< distance of the middles of edges and of triangles from the face
    int per_turn = 16;  ///< edges along a full turn, at least
    /// Edges of curved faces are at most so many times as long as the bend across them admits; infinite: as long as
    /// they are straight.
    double longest = std::numeric_limits<double>::infinity();
    double shortest = 0;  ///< but may be as long as this
};

/// Triangles that share the nodes of edges.
struct SurfaceTriangles {
    std::vector<Vec3> nodes;                     ///< those of the vertices come first, in their order
    std::vector<std::vector<Index>> edges;       ///< nodes of each edge, from its first vertex to its last
    std::vector<std::vector<TriCorners>> faces;  ///< of each face; counter-clockwise in its parameters
    double chord = 0;                            ///< largest distance of middles of edges and triangles
};

/// Triangulates the faces of \p topology at the given positions, each on its own between the nodes of its edges: an
/// edge gets so many that it keeps to the limits, equally many on arcs of one angle whose radii differ little; a face
/// gets inner nodes only where triangles between those of its edges do not keep to them. Nothing if a face cannot be
/// triangulated that way: parameters that degenerate, edges that cross in the parameter plane however fine they are.
std::optional<SurfaceTriangles> surface_triangles(const GmshModel& model, const Topology& topology,
                                                  std::span<const std::size_t> faces, const SurfaceLimits& limits);

}  // namespace pavior::detail
