#pragma once
/// \file
/// Decides whether two quad meshes are one and the same up to the numbering, given the match of some boundary edge.

#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Half-edges (from, to) of quads in sorted order: which quad, and which of its sides.
class HalfEdgeTable {
public:
    explicit HalfEdgeTable(std::span<const QuadCorners> quads) {
        entries_.reserve(4 * quads.size());
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                entries_.emplace_back(key(quads[q][k], quads[q][(k + 1) % 4]), 4 * q + k);
            }
        }
        std::sort(entries_.begin(), entries_.end());
    }

    /// 4 * quad + side, or nothing.
    [[nodiscard]] std::optional<std::size_t> find(Index from, Index to) const {
        const auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair{key(from, to), std::size_t{0}});
        return at != entries_.end() && at->first == key(from, to) ? std::optional(at->second) : std::nullopt;
    }

private:
    static std::uint64_t key(Index from, Index to) { return (std::uint64_t{from} << 32U) | to; }

    std::vector<std::pair<std::uint64_t, std::size_t>> entries_;
};

}  // namespace detail

/// The node of mesh b that corresponds to each node of mesh a, if the two have one connectivity: walks from the nodes
/// already matched (\p seed: pairs of a node of a and its node of b, with at least one edge of a quad among them) over
/// the quads of a. Both meshes must be oriented alike and connected. Nothing if they differ, or if two nodes of a would
/// become one. O((quads of a + quads of b) log). \p node_count is the number of nodes of a.
[[nodiscard]] inline std::optional<std::vector<Index>> match_quads(std::span<const QuadCorners> a,
                                                                   std::span<const QuadCorners> b,
                                                                   std::size_t node_count,
                                                                   std::span<const std::pair<Index, Index>> seed) {
    constexpr Index none = std::numeric_limits<Index>::max();
    if (a.size() != b.size()) {
        return std::nullopt;
    }
    std::vector<Index> match(node_count, none);
    for (const auto& [from, to] : seed) {
        if (match[from] != none && match[from] != to) {
            return std::nullopt;
        }
        match[from] = to;
    }
    const detail::HalfEdgeTable edges_a(a);
    const detail::HalfEdgeTable edges_b(b);
    std::vector<bool> reached(a.size(), false);
    std::vector<std::size_t> stack;  // half-edges of a whose two nodes are matched
    for (std::size_t h = 0; h < 4 * a.size(); ++h) {
        if (match[a[h / 4][h % 4]] != none && match[a[h / 4][(h + 1) % 4]] != none) {
            stack.push_back(h);
        }
    }
    while (!stack.empty()) {
        const std::size_t h = stack.back();
        stack.pop_back();
        if (reached[h / 4]) {
            continue;
        }
        reached[h / 4] = true;
        const QuadCorners& from = a[h / 4];
        const auto other = edges_b.find(match[from[h % 4]], match[from[(h + 1) % 4]]);
        if (!other) {
            return std::nullopt;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            Index& at = match[from[(h + k) % 4]];
            const Index to = b[*other / 4][(*other + k) % 4];
            if (at != none && at != to) {
                return std::nullopt;
            }
            at = to;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (const auto neighbour = edges_a.find(from[(k + 1) % 4], from[k]);
                neighbour && !reached[*neighbour / 4]) {
                stack.push_back(*neighbour);
            }
        }
    }
    std::vector<Index> images = match;
    std::sort(images.begin(), images.end());
    const bool complete = std::find(reached.begin(), reached.end(), false) == reached.end() &&
                          (images.empty() || images.back() != none) &&
                          std::adjacent_find(images.begin(), images.end()) == images.end();
    return complete ? std::optional(std::move(match)) : std::nullopt;
}

}  // namespace pavior
