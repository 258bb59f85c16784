#pragma once

#include <pavior/block/verify_blocks.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE bool BlockReport::conforming() const {
    return double_neighbours.empty() &&
           std::all_of(mesh.findings().begin(), mesh.findings().end(), [](const Finding& f) {
               return f.fault == MeshFault::inverted || f.fault == MeshFault::duplicate_node;
           });
}

PAVIOR_INLINE std::string BlockReport::text() const {
    std::string lines = mesh.text();
    if (!double_neighbours.empty()) {
        lines += (lines.empty() ? "" : "\n") + std::to_string(double_neighbours.size() / 2) +
                 " pairs of blocks with two quads in common";
    }
    return lines;
}

PAVIOR_INLINE BlockReport verify_blocks(const BlockMesh& blocks, std::span<const Vec3> positions) {
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
