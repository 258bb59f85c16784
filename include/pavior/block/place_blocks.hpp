#pragma once
/// \file
/// Coordinates for the nodes of blocks.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/detail/block_placer.hpp>
#include <pavior/core/error.hpp>

#include <array>
#include <cstddef>

namespace pavior {

/// Places the nodes of \p blocks: vertices where they are, chains at half of their arc length, patches at the point of
/// their surface nearest to its centroid, cells at their centroid. Nodes of blocks that are not sufficient are then
/// moved along their chains, on their surfaces and inside, a node at a time, as long as the blocks round them become
/// better. Blocks that stay inverted are reported: their edges are straight, so that a block of a curved patch can be
/// inverted although its refinement is not.
/// O(blocks) a round. Deterministic, thread-safe.
/// \throws InputError size_mismatch unless \p geometry is that of the cell complex of \p blocks, bad_option
[[nodiscard]] inline BlockPlacement place_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                 const PlaceOptions& options = {}) {
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
