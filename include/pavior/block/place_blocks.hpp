#pragma once
/// \file
/// Coordinates for the nodes of blocks.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

/// Options of place_blocks().
struct PlaceOptions {
    /// Blocks with a scaled Jacobian below this are worth moving nodes for, in [0, 1). Above it nodes stay where the
    /// first placement puts them.
    double sufficient = 0.1;
    /// Rounds over the nodes of such blocks; 0: no node is moved.
    int max_rounds = 40;
    /// Its token ends the call; one thread whatever it says.
    Execution execution = sequential;
};

/// Where the nodes of blocks lie.
struct BlockPlacement {
    std::vector<Vec3> positions;  ///< one a block node
    /// One a block node, by its dimension: nothing (0); fraction of the arc length of the chain (1); place in the
    /// polygon of the patch, z = 0 (2); the position itself (3).
    std::vector<Vec3> parameters;
    std::vector<Index> inverted;  ///< blocks with a scaled Jacobian that is not positive, ascending
    double min_jacobian = 1.0;    ///< smallest scaled Jacobian (hex_scaled_jacobian()); 1 without blocks
    std::size_t moved = 0;        ///< nodes that are not where the first placement put them
};

/// Places the nodes of \p blocks: vertices where they are, chains at half of their arc length, patches at the point of
/// their surface nearest to its centroid, cells at their centroid. Nodes of blocks that are not sufficient are then
/// moved along their chains, on their surfaces and inside, a node at a time, as long as the blocks round them become
/// better. Blocks that stay inverted are reported: their edges are straight, so that a block of a curved patch can be
/// inverted although its refinement is not.
/// O(blocks) a round. Deterministic, thread-safe.
/// \throws InputError size_mismatch unless \p geometry is that of the cell complex of \p blocks, bad_option;
/// Stopped
[[nodiscard]] PAVIOR_INLINE BlockPlacement place_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                        const PlaceOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/place_blocks-inl.hpp>
#endif
