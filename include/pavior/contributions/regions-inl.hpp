#pragma once

#include <pavior/contributions/regions.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void number_regions(const TetTopology& topology, const PieceIds& ids, DisjointSets<>& sets,
                                  Regions& out) {
    std::vector<char> used(topology.node_count(), 0);
    for (const auto& edge : topology.edges) {
        used[edge[0]] = used[edge[1]] = 1;
    }
    const auto region_of = [&](Index root) {
        return root < ids.faces   ? out.tet[root]
               : root < ids.edges ? out.face[root - ids.faces]
               : root < ids.nodes ? out.edge[root - ids.edges]
                                  : out.node[root - ids.nodes];
    };
    const std::array<std::size_t, 5> bounds{0, ids.faces, ids.edges, ids.nodes, ids.end};
    const std::array<std::vector<Index>*, 4> parts{&out.tet, &out.face, &out.edge, &out.node};
    for (std::size_t part = 0; part < 4; ++part) {
        parts[part]->assign(bounds[part + 1] - bounds[part], no_index);
        out.begin[part + 1] = out.begin[part];
        for (std::size_t i = bounds[part]; i < bounds[part + 1]; ++i) {
            const Index root = sets.root(static_cast<Index>(i));
            Index& region = (*parts[part])[i - bounds[part]];
            if (root != i) {
                region = region_of(root);
            } else if (part < 3 || used[i - ids.nodes] != 0) {
                region = out.begin[part + 1]++;
                out.representative.push_back(static_cast<Index>(i - bounds[part]));
            }
        }
    }
}

}  // namespace detail

}  // namespace pavior
