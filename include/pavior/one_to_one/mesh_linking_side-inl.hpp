#pragma once

#include <pavior/one_to_one/mesh_linking_side.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<Index> grid_ids(BoundaryMesh& mesh, const StructuredGrid<Vec3>& grid, const SideChain& bottom,
                                          const SideChain& right, const SideChain& top, const SideChain& left) {
    std::vector<Index> ids(grid.nodes.size());
    for (std::size_t k = 0; k <= grid.rows; ++k) {
        for (std::size_t i = 0; i <= grid.columns; ++i) {
            ids[grid.index(i, k)] = k == 0              ? bottom.ids[i]
                                    : k == grid.rows    ? top.ids[i]
                                    : i == 0            ? left.ids[k]
                                    : i == grid.columns ? right.ids[k]
                                                        : mesh.add_node(grid(i, k));
        }
    }
    return ids;
}

PAVIOR_INLINE LogicalFace logical_face(const LinkingSide& side) {
    LogicalLoop loop;
    for (const auto& [use, role] : outline_of(side)) {
        loop.uses.push_back(side.outward ? use : OrientedEdge{use.edge, !use.forward});
        const int heading = static_cast<int>(role);  // seen from inside, +s is where bottom came from
        loop.heading.push_back(side.outward ? heading : heading % 2 == 0 ? heading : 4 - heading);
    }
    if (!side.outward) {
        std::reverse(loop.uses.begin(), loop.uses.end());
        std::reverse(loop.heading.begin(), loop.heading.end());
    }
    LogicalFace result;
    result.loops.push_back(std::move(loop));
    return result;
}

}  // namespace detail

}  // namespace pavior
