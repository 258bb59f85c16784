#pragma once
/// \file
/// Coordinates for the nodes of blocks.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/detail/block_placer.hpp>
#include <pavior/core/compiled.hpp>

namespace pavior {

/// Places the nodes of \p blocks: vertices where they are, chains at half of their arc length, patches at the point of
/// their surface nearest to its centroid, cells at their centroid. Nodes of blocks that are not sufficient are then
/// moved along their chains, on their surfaces and inside, a node at a time, as long as the blocks round them become
/// better. Blocks that stay inverted are reported: their edges are straight, so that a block of a curved patch can be
/// inverted although its refinement is not.
/// O(blocks) a round. Deterministic, thread-safe.
/// \throws InputError size_mismatch unless \p geometry is that of the cell complex of \p blocks, bad_option
[[nodiscard]] PAVIOR_INLINE BlockPlacement place_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                        const PlaceOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/place_blocks-inl.hpp>
#endif
