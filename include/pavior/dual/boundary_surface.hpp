#pragma once
/// \file
/// The boundary of a tetrahedral mesh as a triangulated surface, and its dihedral angles.

#include <pavior/dual/detail/index_sets.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
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

inline void link_boundary_edges(const TetTopology& topology, BoundarySurface& out) {
    std::vector<Index> place(topology.edges.size(), no_index);
    for (const Index f : out.faces) {
        for (const Index e : topology.face_edges[f]) {
            place[e] = 0;
        }
    }
    for (const Index e : IndexRange(place.size())) {
        if (place[e] == 0) {
            place[e] = static_cast<Index>(out.edges.size());
            out.edges.push_back(e);
        }
    }
    out.edge_triangles.assign(out.edges.size(), {no_index, no_index});
    for (const Index b : IndexRange(out.faces.size())) {
        out.triangle_edges.push_back({});
        for (std::size_t k = 0; k < 3; ++k) {
            const Index e = topology.face_edges[out.faces[b]][k];
            auto& both = out.edge_triangles[place[e]];
            if (both[1] != no_index) {
                const auto [low, high] = topology.edges[e];
                throw InputError(ErrorCode::non_manifold,
                                 "the boundary of the tetrahedra touches itself along the edge of nodes " +
                                     std::to_string(low) + " and " + std::to_string(high),
                                 {low, high});
            }
            both[both[0] == no_index ? 0 : 1] = b;
            out.triangle_edges.back()[k] = place[e];
        }
    }
}

/// Throws if the triangles round a node fall into two fans.
inline void check_fans(const TetTopology& topology, const BoundarySurface& surface) {
    const auto corner = [&](Index triangle, Index node) {
        const TriCorners& c = surface.triangles[triangle];
        return static_cast<Index>(3 * triangle + (c[0] == node ? 0 : c[1] == node ? 1 : 2));
    };
    IndexSets fans(3 * surface.triangles.size());
    for (std::size_t s = 0; s < surface.edges.size(); ++s) {
        for (const Index node : topology.edges[surface.edges[s]]) {
            fans.unite(corner(surface.edge_triangles[s][0], node), corner(surface.edge_triangles[s][1], node));
        }
    }
    std::vector<char> seen(topology.node_count(), 0);
    for (const Index i : IndexRange(fans.size())) {
        const Index node = surface.triangles[i / 3][i % 3];
        if (fans.root(i) == i && std::exchange(seen[node], 1) != 0) {
            throw InputError(ErrorCode::non_manifold,
                             "the boundary of the tetrahedra touches itself at node " + std::to_string(node), {node});
        }
    }
}
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
