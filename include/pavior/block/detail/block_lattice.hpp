#pragma once
/// \file
/// Numbers of the nodes inside of divided blocks.

#include <pavior/block/block_mesh.hpp>
#include <pavior/block/sheet_intervals.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior::detail {

/// The nodes of divided blocks: those of the blocks, then those inside of the edges, the quads, the hexahedra, each in
/// their order. Edges run up in dimension, and quads and hexahedra begin at their node of lowest dimension, so that all
/// blocks number the nodes they share the same way.
class BlockLattice {
public:
    /// Intervals or positions along the directions 01, 03, 04 of a hexahedron.
    using Lattice = std::array<std::uint32_t, 3>;

    BlockLattice(const BlockMesh& blocks, std::span<const SheetIntervals> sheets) : blocks_(blocks), sheets_(sheets) {
        find_quad_edges();
        number();
    }

    [[nodiscard]] std::size_t node_count() const { return hex_base_.back(); }
    [[nodiscard]] std::size_t hex_count() const { return cell_base_.back(); }
    /// The first hexahedron in block \p h.
    [[nodiscard]] std::size_t first_hex(Index h) const { return cell_base_[h]; }
    /// Edge k of quad \p q joins its corners k and k + 1.
    [[nodiscard]] const std::array<Index, 4>& quad_edges(Index q) const { return quad_edges_[q]; }

    [[nodiscard]] std::uint32_t edge_intervals(Index e) const { return sheets_[blocks_.sheets[e]].intervals; }
    /// Intervals of a quad along its first edge (corners 0 1) and its last one (corners 0 3).
    [[nodiscard]] std::array<std::uint32_t, 2> quad_intervals(Index q) const {
        const auto& e = quad_edges_[q];
        return {edge_intervals(e[0]), edge_intervals(e[3])};
    }
    [[nodiscard]] Lattice hex_intervals(Index h) const {
        const auto s = blocks_.hex_sheets(h);
        return {sheets_[s[0]].intervals, sheets_[s[1]].intervals, sheets_[s[2]].intervals};
    }

    /// Node i of edge \p e, from its first node.
    [[nodiscard]] Index edge_node(Index e, std::uint32_t i) const {
        return i == 0                   ? blocks_.edges[e][0]
               : i == edge_intervals(e) ? blocks_.edges[e][1]
                                        : static_cast<Index>(edge_base_[e] + i - 1);
    }

    /// Node (i, j) of quad \p q: i along its corners 0 1, j along 0 3.
    [[nodiscard]] Index quad_node(Index q, std::uint32_t i, std::uint32_t j) const {
        const auto n = quad_intervals(q);
        const auto& e = quad_edges_[q];
        return j == 0      ? edge_node(e[0], i)
               : j == n[1] ? edge_node(e[2], i)
               : i == 0    ? edge_node(e[3], j)
               : i == n[0] ? edge_node(e[1], j)
                           : static_cast<Index>(quad_base_[q] + std::size_t{j - 1} * (n[0] - 1) + i - 1);
    }

    /// The six quads of a hexahedron as lattices: node (a, b) of face f, a and b along the directions of the
    /// hexahedron other than that of the face, in their order.
    [[nodiscard]] Index face_node(Index h, std::size_t f, std::uint32_t a, std::uint32_t b) const {
        constexpr std::array<std::size_t, 6> along{1, 5, 1, 2, 2, 3};  // next to the lowest corner in direction a
        const Index q = blocks_.hex_quads[h][f];
        return blocks_.quads[q][1] == blocks_.hexes[h][along[f]] ? quad_node(q, a, b) : quad_node(q, b, a);
    }

    /// Node (i, j, k) of block \p h.
    [[nodiscard]] Index hex_node(Index h, const Lattice& n, std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return k == 0      ? face_node(h, 0, i, j)
               : k == n[2] ? face_node(h, 1, i, j)
               : j == 0    ? face_node(h, 2, i, k)
               : j == n[1] ? face_node(h, 4, i, k)
               : i == 0    ? face_node(h, 5, j, k)
               : i == n[0]
                   ? face_node(h, 3, j, k)
                   : static_cast<Index>(hex_base_[h] + (std::size_t{k - 1} * (n[1] - 1) + j - 1) * (n[0] - 1) + i - 1);
    }

private:
    void find_quad_edges() {
        quad_edges_.resize(blocks_.quads.size());
        for (std::size_t h = 0; h < blocks_.hexes.size(); ++h) {
            for (std::size_t f = 0; f < 6; ++f) {
                const Index q = blocks_.hex_quads[h][f];
                const QuadCorners& c = blocks_.quads[q];
                for (const int local : hex_face_edges[f]) {
                    const Index e = blocks_.hex_edges[h][static_cast<std::size_t>(local)];
                    for (std::size_t k = 0; k < 4; ++k) {
                        const auto& ends = blocks_.edges[e];
                        if (std::minmax(c[k], c[(k + 1) % 4]) == std::minmax(ends[0], ends[1])) {
                            quad_edges_[q][k] = e;
                        }
                    }
                }
            }
        }
    }

    void number() {
        std::size_t at = blocks_.nodes.size();
        for (std::size_t e = 0; e < blocks_.edges.size(); ++e) {
            edge_base_.push_back(at);
            at += edge_intervals(static_cast<Index>(e)) - 1;
        }
        for (std::size_t q = 0; q < blocks_.quads.size(); ++q) {
            quad_base_.push_back(at);
            const auto n = quad_intervals(static_cast<Index>(q));
            at += std::size_t{n[0] - 1} * (n[1] - 1);
        }
        std::size_t cells = 0;
        for (std::size_t h = 0; h < blocks_.hexes.size(); ++h) {
            const Lattice n = hex_intervals(static_cast<Index>(h));
            hex_base_.push_back(at);
            cell_base_.push_back(cells);
            check_size(static_cast<double>(at) + static_cast<double>(n[0]) * n[1] * n[2]);
            at += std::size_t{n[0] - 1} * (n[1] - 1) * (n[2] - 1);
            cells += std::size_t{n[0]} * n[1] * n[2];
        }
        check_size(static_cast<double>(std::max(at, cells)));
        hex_base_.push_back(at);
        cell_base_.push_back(cells);
    }

    static void check_size(double count) {
        if (count >= static_cast<double>(no_index)) {
            throw InputError(ErrorCode::overflow, "the fine mesh would have 2^32 nodes or more");
        }
    }

    const BlockMesh& blocks_;
    std::span<const SheetIntervals> sheets_;
    std::vector<std::array<Index, 4>> quad_edges_;
    std::vector<std::size_t> edge_base_, quad_base_, hex_base_, cell_base_;  // first inner node, first hexahedron
};

}  // namespace pavior::detail
