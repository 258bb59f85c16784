#pragma once

#include <pavior/marking/cut_tets.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

/// Finds the cut of an edge; cuts are sorted by (low, high).
class CutTable {
public:
    CutTable(std::span<const EdgeCut> cuts, std::size_t nodes) : cuts_(cuts), first_(nodes + 1, 0) {
        for (const EdgeCut& cut : cuts) {
            ++first_[cut.low + std::size_t{1}];
        }
        for (std::size_t i = 1; i < first_.size(); ++i) {
            first_[i] += first_[i - 1];
        }
    }

    /// The position of the cut on edge a b, or the number of cuts.
    [[nodiscard]] std::size_t find(Index a, Index b) const {
        const Index low = std::min(a, b);
        const Index high = std::max(a, b);
        if (low + std::size_t{1} < first_.size()) {
            for (std::size_t k = first_[low]; k < first_[low + std::size_t{1}]; ++k) {
                if (cuts_[k].high == high) {
                    return k;
                }
            }
        }
        return cuts_.size();
    }
    [[nodiscard]] std::size_t size() const { return cuts_.size(); }

private:
    std::span<const EdgeCut> cuts_;
    std::vector<std::size_t> first_;
};

/// Calls emit(simplex) for the pieces of a simplex. All simplices bisect their first cut (in the order of the table)
/// first, so that pieces of neighbours fit; the order of the nodes, hence the orientation, is kept.
template <std::size_t N, class Emit>
void bisect(const CutTable& table, const std::array<Index, N>& simplex, Index first_new, Emit& emit) {
    std::size_t best = table.size();
    std::array<std::size_t, 2> at{};
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = i + 1; j < N; ++j) {
            const std::size_t cut = table.find(simplex[i], simplex[j]);
            if (cut < best) {
                best = cut;
                at = {i, j};
            }
        }
    }
    if (best == table.size()) {
        emit(simplex);
        return;
    }
    for (const std::size_t replaced : at) {
        std::array<Index, N> piece = simplex;
        piece[replaced] = first_new + static_cast<Index>(best);
        bisect(table, piece, first_new, emit);
    }
}

/// Replaces items by their pieces, in place and in order. `nodes_of(item)` is a reference to the array of nodes.
template <class Item, class NodesOf, class Copied>
void bisect_all(const CutTable& table, Index first_new, std::vector<Item>& items, NodesOf nodes_of, Copied copied) {
    std::vector<Item> pieces;
    pieces.reserve(items.size() + items.size() / 4);
    for (std::size_t i = 0; i < items.size(); ++i) {
        Item item = items[i];
        auto emit = [&](const auto& nodes) {
            nodes_of(item) = nodes;
            pieces.push_back(item);
            copied(i);
        };
        const auto nodes = nodes_of(item);
        bisect(table, nodes, first_new, emit);
    }
    items.swap(pieces);
}

}  // namespace detail

PAVIOR_INLINE void bisect_edges(CutMesh& cut, std::span<const EdgeCut> cuts) {
    if (cuts.empty()) {
        return;
    }
    ReferenceMesh& mesh = cut.mesh;
    const detail::CutTable table(cuts, mesh.nodes.size());
    const auto first_new = static_cast<Index>(mesh.nodes.size());
    for (const EdgeCut& c : cuts) {
        const Vec3 x = mesh.nodes[c.low] + c.fraction * (mesh.nodes[c.high] - mesh.nodes[c.low]);
        mesh.nodes.push_back(x);
    }
    const auto ignore = [](std::size_t) {};
    const auto itself = [](auto& item) -> auto& { return item; };
    const auto member = [](auto& item) -> auto& { return item.nodes; };
    std::vector<Index> sheets;
    std::vector<char> marks;
    const bool marked = !cut.marks.empty();
    detail::bisect_all(table, first_new, mesh.tets, itself, [&](std::size_t i) {
        if (marked) {
            marks.push_back(cut.marks[i]);
        }
    });
    cut.marks.swap(marks);
    detail::bisect_all(table, first_new, mesh.patches, member, ignore);
    detail::bisect_all(table, first_new, mesh.curves, member, ignore);
    detail::bisect_all(table, first_new, mesh.layers, itself,
                       [&](std::size_t i) { sheets.push_back(cut.layer_sheets[i]); });
    cut.layer_sheets.swap(sheets);
}

}  // namespace pavior
