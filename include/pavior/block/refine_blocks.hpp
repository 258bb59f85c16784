#pragma once
/// \file
/// A fine hexahedral mesh inside the blocks, on the geometry.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/sheet_intervals.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/smooth/report.hpp>

#include <cstdint>
#include <map>
#include <vector>

namespace pavior {

/// Options of refine_blocks().
struct RefineOptions {
    /// Wanted length of the edges of hexahedra, in the unit of the coordinates; <= 0 (default): no wish, two intervals
    /// on every block edge.
    double size = 0.0;
    /// With a size, edges of blocks on curved geometry turn by at most so many degrees from one interval to the next.
    double max_angle = 30.0;
    /// Other lengths, by tag of the curve or patch of the geometry; see sheet_intervals().
    std::map<int, double> curve_size = {};
    std::map<int, double> patch_size = {};
    /// One number of intervals a sheet, each >= 1; empty (default): from the sizes.
    std::vector<std::uint32_t> intervals = {};
    /// Repair inverted hexahedra by moving inner nodes.
    bool untangle = true;
    /// Also move inner nodes where nothing is inverted, for the shape of the hexahedra. Slow.
    bool optimise = false;
    /// Threads, and the token that ends the call.
    Execution execution = sequential;
    /// Stages "nodes" and those of untangle_hexes(): from 0 to 1, never backwards.
    Progress progress = {};
};

/// A boundary quad of the fine mesh.
struct BlockQuad {
    QuadCorners nodes{};   ///< counter-clockwise seen from outside
    Index patch = 0;       ///< of the cell complex
    std::int32_t tag = 0;  ///< of the patch of the geometry at its middle

    friend bool operator==(const BlockQuad&, const BlockQuad&) = default;
};

/// A fine mesh inside blocks.
struct RefinedBlocks {
    /// Nodes: those of the blocks in their order, then those inside of edges, of quads, of hexahedra, each in the order
    /// of BlockMesh. Hexahedra: block by block, i fastest, then j, k along its directions 01, 03, 04.
    HexMesh mesh;
    std::vector<Index> node_origin;  ///< a block node a node: in its vertex, chain, patch or cell the node lies
    std::vector<Index> hex_block;    ///< a block a hexahedron
    std::vector<BlockQuad> boundary;
    std::vector<SheetIntervals> sheets;
    SmoothReport untangling;             ///< of the inner nodes
    std::vector<Index> inverted_blocks;  ///< blocks that hold inverted hexahedra, ascending
};

/// Divides each block into hexahedra, as many in each direction as its sheets have intervals, by transfinite
/// interpolation. The mesh is conforming by construction: blocks share the nodes of their edges and quads. Nodes of
/// the boundary lie on the triangles of the reference mesh, those of chains on their polylines at even arc length;
/// inner patches are followed too. Inverted hexahedra are then repaired by moving inner nodes, as far as that is
/// possible: see RefinedBlocks::untangling and inverted_blocks.
/// O(nodes). Deterministic: the same bytes for any number of threads.
/// \throws InputError size_mismatch (placement, geometry or intervals not of these blocks), bad_option (an interval of
/// 0, a size that is not finite), overflow (2^32 nodes or more); Stopped
[[nodiscard]] PAVIOR_INLINE RefinedBlocks refine_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                        const BlockPlacement& placement,
                                                        const RefineOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/refine_blocks-inl.hpp>
#endif
