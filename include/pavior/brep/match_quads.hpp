#pragma once
/// \file
/// Decides whether two quad meshes are one and the same up to the numbering, given the match of some boundary edge.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Half-edges (from, to) of quads in sorted order: which quad, and which of its sides.
class HalfEdgeTable {
public:
    explicit HalfEdgeTable(std::span<const QuadCorners> quads);

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
[[nodiscard]] PAVIOR_INLINE std::optional<std::vector<Index>> match_quads(
    std::span<const QuadCorners> a, std::span<const QuadCorners> b, std::size_t node_count,
    std::span<const std::pair<Index, Index>> seed);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/match_quads-inl.hpp>
#endif
