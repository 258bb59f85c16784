#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/dual/boundary_surface.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void link_boundary_edges(const TetTopology& topology, BoundarySurface& out) {
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

PAVIOR_INLINE void check_fans(const TetTopology& topology, const BoundarySurface& surface) {
    const auto corner = [&](Index triangle, Index node) {
        const TriCorners& c = surface.triangles[triangle];
        return static_cast<Index>(3 * triangle + (c[0] == node ? 0 : c[1] == node ? 1 : 2));
    };
    DisjointSets fans(3 * surface.triangles.size());
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

}  // namespace pavior
