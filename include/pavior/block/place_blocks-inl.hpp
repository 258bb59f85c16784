#pragma once

#include <pavior/block/detail/block_placer.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/core/error.hpp>

#include <array>
#include <cstddef>

namespace pavior {

PAVIOR_INLINE BlockPlacement place_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                          const PlaceOptions& options) {
    if (!(options.sufficient >= 0.0 && options.sufficient < 1.0) || options.max_rounds < 0) {
        throw InputError(ErrorCode::bad_option, "PlaceOptions: sufficient in [0, 1) and max_rounds >= 0 expected");
    }
    const std::array<std::size_t, 4> counts{geometry.vertices.size(), geometry.chains.size(), geometry.patches.size(),
                                            geometry.cells.size()};
    for (std::size_t d = 0; d < 4; ++d) {
        if (blocks.first[d + 1] - blocks.first[d] != counts[d]) {
            throw InputError(ErrorCode::size_mismatch, "blocks and geometry are not of one cell complex");
        }
    }
    return detail::BlockPlacer(blocks, geometry, options).run();
}

}  // namespace pavior
