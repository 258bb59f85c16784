#pragma once
/// \file
/// Are these blocks a valid hexahedral mesh of the solid?

#include <pavior/block/block_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// What verify_blocks() counts and finds.
struct BlockReport {
    std::size_t vertices = 0, chains = 0, patches = 0, cells = 0;  ///< nodes of the blocks by origin
    std::size_t blocks = 0, edges = 0, quads = 0, boundary_quads = 0, sheets = 0;
    std::int64_t euler = 0;  ///< nodes - edges + quads - blocks: 1 for a ball, 0 for a solid torus, 2 with one cavity
    /// Pairs of blocks with two quads in common; one pair of ids after the other.
    std::vector<Index> double_neighbours;
    HexReport mesh;  ///< conforming, positive at the corners, boundary closed

    [[nodiscard]] std::size_t nodes() const { return vertices + chains + patches + cells; }
    /// True if the blocks are conforming and closed, whatever their shapes.
    [[nodiscard]] bool conforming() const;
    /// True if they are also positive, so that they are a mesh of their own.
    [[nodiscard]] bool ok() const { return mesh.ok() && double_neighbours.empty(); }
    /// One line a finding; empty if ok().
    [[nodiscard]] std::string text() const;
};

/// Checks \p blocks with their nodes at \p positions. Everything is said in the report. O(n log n), thread-safe.
/// \throws InputError size_mismatch unless there is one position a node
[[nodiscard]] PAVIOR_INLINE BlockReport verify_blocks(const BlockMesh& blocks, std::span<const Vec3> positions);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/verify_blocks-inl.hpp>
#endif
