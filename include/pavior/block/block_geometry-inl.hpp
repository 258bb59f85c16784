#pragma once

#include <pavior/block/block_geometry.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE Members::Members(const std::vector<Index>& class_of, std::size_t classes) : begin(classes + 1, 0) {
    for (const Index c : class_of) {
        if (c != no_index) {
            ++begin[c + 1];
        }
    }
    for (std::size_t c = 0; c < classes; ++c) {
        begin[c + 1] += begin[c];
    }
    items.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < class_of.size(); ++i) {
        if (class_of[i] != no_index) {
            items[next[class_of[i]]++] = static_cast<Index>(i);
        }
    }
}

PAVIOR_INLINE std::vector<Index> side_nodes(const CellComplex& complex, const PatchSide& side) {
    const std::span<const Index> path = complex.chain_path(side.chain);
    std::vector<Index> nodes(path.begin(), path.end());
    if (side.reversed) {
        std::reverse(nodes.begin(), nodes.end());
    }
    return nodes;
}

}  // namespace detail

}  // namespace pavior
