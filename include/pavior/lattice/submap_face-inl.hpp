#pragma once

#include <pavior/lattice/submap_face.hpp>

#include <algorithm>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<QuadCorners> lattice_quads(const LogicalGrid<2>& grid) {
    std::vector<QuadCorners> quads;
    grid.for_each_cell([&](const LatticePoint<2>& c) {
        quads.push_back(
            {grid.node(c), grid.node({c[0] + 1, c[1]}), grid.node({c[0] + 1, c[1] + 1}), grid.node({c[0], c[1] + 1})});
    });
    return quads;
}

}  // namespace detail

}  // namespace pavior
