#pragma once
/// \file
/// Are these blocks a valid hexahedral mesh of the solid?

#include <pavior/block/block_mesh.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <array>
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
    [[nodiscard]] bool conforming() const {
        return double_neighbours.empty() &&
               std::all_of(mesh.findings().begin(), mesh.findings().end(), [](const Finding& f) {
                   return f.fault == MeshFault::inverted || f.fault == MeshFault::duplicate_node;
               });
    }
    /// True if they are also positive, so that they are a mesh of their own.
    [[nodiscard]] bool ok() const { return mesh.ok() && double_neighbours.empty(); }
    /// One line a finding; empty if ok().
    [[nodiscard]] std::string text() const {
        std::string lines = mesh.text();
        if (!double_neighbours.empty()) {
            lines += (lines.empty() ? "" : "\n") + std::to_string(double_neighbours.size() / 2) +
                     " pairs of blocks with two quads in common";
        }
        return lines;
    }
};

/// Checks \p blocks with their nodes at \p positions. Everything is said in the report. O(n log n), thread-safe.
/// \throws InputError size_mismatch unless there is one position a node
[[nodiscard]] inline BlockReport verify_blocks(const BlockMesh& blocks, std::span<const Vec3> positions) {
    if (positions.size() != blocks.nodes.size()) {
        throw InputError(ErrorCode::size_mismatch, std::to_string(positions.size()) + " positions for " +
                                                       std::to_string(blocks.nodes.size()) + " block nodes");
    }
    BlockReport report;
    std::array<std::size_t*, 4> counts{&report.vertices, &report.chains, &report.patches, &report.cells};
    for (std::size_t d = 0; d < 4; ++d) {
        *counts[d] = blocks.first[d + 1] - blocks.first[d];
    }
    report.blocks = blocks.hexes.size();
    report.edges = blocks.edges.size();
    report.quads = blocks.quads.size();
    report.sheets = blocks.sheet_count;
    report.euler = static_cast<std::int64_t>(blocks.nodes.size() + report.quads) -
                   static_cast<std::int64_t>(report.edges + report.blocks);
    std::vector<std::array<Index, 2>> neighbours;
    for (const auto& pair : blocks.quad_hexes) {
        if (pair[1] == no_index) {
            ++report.boundary_quads;
        } else {
            neighbours.push_back(pair);
        }
    }
    std::sort(neighbours.begin(), neighbours.end());
    for (std::size_t i = 1; i < neighbours.size(); ++i) {
        if (neighbours[i] == neighbours[i - 1] && (i < 2 || neighbours[i] != neighbours[i - 2])) {
            report.double_neighbours.insert(report.double_neighbours.end(), neighbours[i].begin(), neighbours[i].end());
        }
    }
    report.mesh = verify_hexes(HexMeshView<Vec3, HexCorners>{positions, blocks.hexes});
    return report;
}

}  // namespace pavior
