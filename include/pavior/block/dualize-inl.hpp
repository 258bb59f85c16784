#pragma once

#include <pavior/block/dualize.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void require_regular(const CellCorner& corner) {
    bool complete = corner.regular() && corner.vertex != no_index && corner.cell != no_index;
    for (std::size_t k = 0; k < 3; ++k) {
        complete = complete && corner.chains[k] != no_index && corner.patches[k] != no_index;
    }
    if (!complete) {
        throw InputError(ErrorCode::invalid_dual,
                         "a corner of cell " + std::to_string(corner.cell) + " at vertex " +
                             std::to_string(corner.vertex) + " has not three chains but " +
                             std::to_string(corner.valence),
                         {corner.vertex});
    }
}

PAVIOR_INLINE std::vector<HexCorners> ordered_blocks(const Regions& regions, const DualBlocks& dual) {
    if (dual.irregular != 0) {
        throw InputError(ErrorCode::invalid_dual, "the regions round " + std::to_string(dual.irregular) +
                                                      " dual points do not form a hexahedron");
    }
    const auto node_of = [&](Index region) {  // vertices, chains, patches, cells, each in the order of its regions
        const auto part = static_cast<std::size_t>(3 - regions.dimension(region));
        return regions.count() - regions.begin[part + 1] + region - regions.begin[part];
    };
    std::vector<std::pair<Index, HexCorners>> found;  // with the smallest tetrahedron
    for (std::size_t b = 0; b < dual.blocks.size(); ++b) {
        HexCorners h = dual.blocks[b];
        std::transform(h.begin(), h.end(), h.begin(), node_of);
        while (h[1] > h[3] || h[1] > h[4]) {
            h = {h[0], h[3], h[7], h[4], h[1], h[2], h[6], h[5]};
        }
        found.emplace_back(dual.tet[b], h);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return std::pair(a.second[0], a.first) < std::pair(b.second[0], b.first);
    });
    std::vector<HexCorners> hexes;
    hexes.reserve(found.size());
    for (const auto& [tet, h] : found) {
        hexes.push_back(h);
    }
    return hexes;
}

}  // namespace detail

}  // namespace pavior
