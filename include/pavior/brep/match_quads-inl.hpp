#pragma once

#include <pavior/brep/match_quads.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE HalfEdgeTable::HalfEdgeTable(std::span<const QuadCorners> quads) {
    entries_.reserve(4 * quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        for (std::size_t k = 0; k < 4; ++k) {
            entries_.emplace_back(key(quads[q][k], quads[q][(k + 1) % 4]), 4 * q + k);
        }
    }
    std::sort(entries_.begin(), entries_.end());
}

}  // namespace detail

PAVIOR_INLINE std::optional<std::vector<Index>> match_quads(std::span<const QuadCorners> a,
                                                            std::span<const QuadCorners> b, std::size_t node_count,
                                                            std::span<const std::pair<Index, Index>> seed) {
    if (a.size() != b.size()) {
        return std::nullopt;
    }
    std::vector<Index> match(node_count, no_index);
    for (const auto& [from, to] : seed) {
        if (match[from] != no_index && match[from] != to) {
            return std::nullopt;
        }
        match[from] = to;
    }
    const detail::HalfEdgeTable edges_a(a);
    const detail::HalfEdgeTable edges_b(b);
    std::vector<bool> reached(a.size(), false);
    std::vector<std::size_t> stack;  // half-edges of a whose two nodes are matched
    for (std::size_t h = 0; h < 4 * a.size(); ++h) {
        if (match[a[h / 4][h % 4]] != no_index && match[a[h / 4][(h + 1) % 4]] != no_index) {
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
            if (at != no_index && at != to) {
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
                          (images.empty() || images.back() != no_index) &&
                          std::adjacent_find(images.begin(), images.end()) == images.end();
    return complete ? std::optional(std::move(match)) : std::nullopt;
}

}  // namespace pavior
