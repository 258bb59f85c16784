#pragma once
/// \file
/// The boundary of a tetrahedral mesh as a triangulated surface, and its dihedral angles.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace pavior {

/// The boundary triangles of a tetrahedral mesh: B triangles, S edges.
struct BoundarySurface {
    std::vector<Index> faces;                          ///< B faces of the topology, ascending
    std::vector<TriCorners> triangles;                 ///< B x 3 nodes, counter-clockwise seen from outside
    std::vector<Index> edges;                          ///< S edges of the topology, ascending
    std::vector<std::array<Index, 2>> edge_triangles;  ///< S x 2 triangles, ascending
    std::vector<std::array<Index, 3>> triangle_edges;  ///< B x 3 places in `edges`, no order
};

namespace detail {

PAVIOR_INLINE void link_boundary_edges(const TetTopology& topology, BoundarySurface& out);

/// Throws if the triangles round a node fall into two fans.
PAVIOR_INLINE void check_fans(const TetTopology& topology, const BoundarySurface& surface);

}  // namespace detail

/// The boundary of \p mesh, whose topology is \p topology. O(n).
/// \throws InputError non_manifold where the boundary touches itself: at an edge (its two nodes) or a node (its id)
template <tet_mesh M>
[[nodiscard]] BoundarySurface boundary_surface(const M& mesh, const TetTopology& topology) {
    BoundarySurface out;
    for (const Index f : IndexRange(topology.faces.size())) {
        if (topology.boundary(f)) {
            const Index t = topology.face_tets[f][0];
            out.faces.push_back(f);
            out.triangles.push_back(detail::tet_face(tet(mesh, t), detail::local_face(topology, t, f)));
        }
    }
    detail::link_boundary_edges(topology, out);
    detail::check_fans(topology, out);
    return out;
}

/// Interior dihedral angle in degrees at each of surface.edges: 90 at the edges of a cube, 180 where the surface is
/// flat, 270 at a re-entrant right angle, 360 at the end of a slit. A triangle without area counts as flat. O(S).
template <vertex_mesh M>
[[nodiscard]] std::vector<double> interior_angles(const M& mesh, const TetTopology& topology,
                                                  const BoundarySurface& surface) {
    const auto normal = [&](Index b) -> Vec3 {
        const TriCorners& c = surface.triangles[b];
        const Vec3 x = node(mesh, c[0]);
        return (node(mesh, c[1]) - x).cross(node(mesh, c[2]) - x).stableNormalized();
    };
    std::vector<double> angles(surface.edges.size());
    for (std::size_t s = 0; s < angles.size(); ++s) {
        const auto [first, second] = surface.edge_triangles[s];
        const TriCorners& c = surface.triangles[first];
        auto [a, b] = topology.edges[surface.edges[s]];
        if (!((c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b))) {
            std::swap(a, b);
        }
        const Vec3 along = (node(mesh, b) - node(mesh, a)).stableNormalized();
        const Vec3 n1 = normal(first);
        const Vec3 n2 = normal(second);
        const double angle = 180.0 - std::atan2(n1.cross(n2).dot(along), n1.dot(n2)) * 180.0 / std::numbers::pi;
        angles[s] = angle < 1e-6 ? 360.0 : angle;  // material between two coincident triangles has no volume
    }
    return angles;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/dual/boundary_surface-inl.hpp>
#endif
