#pragma once
/// \file
/// Blocks read off the contributions and regions alone (section 5.4.4 \cite roca2009).

#include <pavior/contributions/regions.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

/// The dual of the dual: one node a region.
struct DualBlocks {
    /// Corners are regions: 0 of dimension 0, 1 3 4 of dimension 1, 2 5 7 of dimension 2, 6 of dimension 3; positive.
    std::vector<HexCorners> blocks;
    std::vector<Index> tet;                   ///< of each block: the smallest tetrahedron round its dual point
    std::vector<std::array<Index, 2>> edges;  ///< regions that a hard contribution separates, ascending
    std::size_t irregular = 0;                ///< dual points whose regions do not form a hexahedron
};

namespace detail {

/// The dual point of the pieces round one node of a tetrahedron, and of those that nothing separates from them.
template <tet_mesh M>
class DualPointReader {
public:
    DualPointReader(const M& mesh, const TetTopology& topology, const std::vector<TetContributions>& contributions,
                    const Regions& regions)
        : mesh_(mesh),
          topology_(topology),
          contributions_(contributions),
          regions_(regions),
          seen_(contributions.size(), 0) {}

    DualBlocks run() {
        DualBlocks out;
        for (const Index t : IndexRange(contributions_.size())) {
            if (!contributions_[t].has_hard_vertex()) {
                continue;
            }
            const TetCorners c = tet(mesh_, t);
            for (std::size_t candidate = vertex_candidates; candidate < candidate_count; ++candidate) {
                const std::size_t k = tet_candidates[candidate].entity;
                if (contributions_[t][candidate] == Contribution::hard && (seen_[t] >> k & 1) == 0) {
                    const Index smallest = flood(t, k, c[k]);
                    const std::optional<HexCorners> block = corners(t, c[k]);
                    out.irregular += block ? 0 : 1;
                    if (block) {
                        out.blocks.push_back(*block);
                        out.tet.push_back(smallest);
                    }
                }
            }
        }
        return out;
    }

private:
    using Pair = std::pair<Index, Index>;

    /// Collects the hard contributions at \p node in tetrahedron t and on across faces that were not added.
    /// \return the smallest tetrahedron met
    Index flood(Index t, std::size_t k, Index node) {
        Index smallest = t;
        pairs_.clear();
        follows_.clear();
        precedes_.clear();
        stack_.assign(1, t);
        seen_[t] = static_cast<std::uint8_t>(seen_[t] | 1U << k);
        while (!stack_.empty()) {
            const Index at = stack_.back();
            stack_.pop_back();
            smallest = std::min(smallest, at);
            const TetCorners c = tet(mesh_, at);
            const std::size_t apex = local_node(c, node);
            collect(at, apex, node);
            for (std::size_t f = 0; f < 4; ++f) {
                if (f != apex && contributions_[at][face_candidates + f] == Contribution::none) {
                    const Index next = topology_.across(topology_.tet_faces[at][f], at);
                    const auto bit = static_cast<std::uint8_t>(1U << local_node(tet(mesh_, next), node));
                    if ((seen_[next] & bit) == 0) {
                        seen_[next] |= bit;
                        stack_.push_back(next);
                    }
                }
            }
        }
        for (auto* pairs : {&pairs_, &follows_, &precedes_}) {
            std::sort(pairs->begin(), pairs->end());
            pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
        }
        return smallest;
    }

    void collect(Index t, std::size_t apex, Index node) {
        const auto hard = [&](std::size_t candidate) { return contributions_[t][candidate] == Contribution::hard; };
        for (std::size_t f = 0; f < 4; ++f) {
            if (f != apex && hard(face_candidates + f)) {
                pairs_.emplace_back(regions_.face[topology_.tet_faces[t][f]], regions_.tet[t]);
            }
        }
        for (std::size_t b = 0; b < 4; ++b) {
            if (b == apex) {
                continue;
            }
            const auto e = static_cast<std::size_t>(tet_edge_between[apex][b]);
            const Index edge = regions_.edge[topology_.tet_edges[t][e]];
            for (std::size_t s = 0; s < 2; ++s) {
                const std::size_t f = edge_faces[e][s];
                const Index face = regions_.face[topology_.tet_faces[t][f]];
                if (hard(edge_candidates + 2 * e + s)) {
                    pairs_.emplace_back(edge, face);
                    (turns_left(apex, b, 6 - apex - b - f) ? follows_ : precedes_).emplace_back(edge, face);
                }
            }
            const std::size_t s = static_cast<std::size_t>(tet_edges[e][0]) == apex ? 0 : 1;
            if (hard(vertex_candidates + 2 * e + s)) {
                pairs_.emplace_back(regions_.node[node], edge);
            }
        }
    }

    /// True if the third edge at local node \p v comes after v a and v b in positive order: (v, a, b, c) is an even
    /// permutation of (0, 1, 2, 3).
    [[nodiscard]] static constexpr bool turns_left(std::size_t v, std::size_t a, std::size_t b) {
        const std::array<std::size_t, 4> p{v, a, b, 6 - v - a - b};
        bool even = true;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                even = p[i] > p[j] ? !even : even;
            }
        }
        return even;
    }

    /// Empty unless the hard contributions form the twelve edges of a hexahedron.
    [[nodiscard]] std::optional<HexCorners> corners(Index t, Index node) const {
        if (pairs_.size() != 12 || follows_.size() != 3 || precedes_.size() != 3) {
            return std::nullopt;
        }
        HexCorners h{};
        h[0] = regions_.node[node];
        h[6] = regions_.tet[t];
        Index chain = follows_[0].first;
        for (const std::size_t k : {0U, 1U, 2U}) {
            constexpr std::array<std::size_t, 3> chain_corner{1, 3, 4};
            constexpr std::array<std::size_t, 3> patch_corner{2, 7, 5};
            const auto after =
                std::find_if(follows_.begin(), follows_.end(), [&](const Pair& pair) { return pair.first == chain; });
            if (after == follows_.end()) {
                return std::nullopt;
            }
            const Index patch = after->second;
            h[chain_corner[k]] = chain;
            h[patch_corner[k]] = patch;
            if (!joined(h[0], chain) || !joined(patch, h[6])) {
                return std::nullopt;
            }
            const auto before = std::find_if(precedes_.begin(), precedes_.end(),
                                             [&](const Pair& pair) { return pair.second == patch; });
            if (before == precedes_.end()) {
                return std::nullopt;
            }
            chain = before->first;
        }
        HexCorners distinct = h;
        std::sort(distinct.begin(), distinct.end());
        const bool closed = chain == h[1] && std::adjacent_find(distinct.begin(), distinct.end()) == distinct.end();
        return closed ? std::optional(h) : std::nullopt;
    }

    [[nodiscard]] bool joined(Index a, Index b) const {
        return std::binary_search(pairs_.begin(), pairs_.end(), Pair(a, b));
    }

    const M& mesh_;
    const TetTopology& topology_;
    const std::vector<TetContributions>& contributions_;
    const Regions& regions_;
    std::vector<std::uint8_t> seen_;
    std::vector<Index> stack_;
    std::vector<Pair> pairs_;     ///< regions joined by hard contributions, that of lower dimension first
    std::vector<Pair> follows_;   ///< (chain, patch) with the patch after the chain in positive order
    std::vector<Pair> precedes_;  ///< (chain, patch) with the patch before the chain
};

/// Different pairs among many that repeat.
class PairCollector {
public:
    void add(Index a, Index b);
    [[nodiscard]] std::vector<std::array<Index, 2>> take() {
        compact();
        return std::move(pairs_);
    }

private:
    void compact() {
        std::sort(pairs_.begin(), pairs_.end());
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    }

    std::array<std::array<Index, 2>, 1024> recent_{};  // {0, 0} is no pair of two regions
    std::vector<std::array<Index, 2>> pairs_;
    std::size_t limit_ = 4096;
};

}  // namespace detail

/// The pairs of regions that some hard contribution separates: primal edges (a, b), a < b, ascending. O(n).
template <tet_mesh M>
[[nodiscard]] std::vector<std::array<Index, 2>> primal_edges(const M& mesh, const TetTopology& topology,
                                                             const std::vector<TetContributions>& contributions,
                                                             const Regions& regions) {
    detail::PairCollector pairs;
    for (const Index t : IndexRange(contributions.size())) {
        if (!contributions[t].has_hard()) {
            continue;
        }
        const TetCorners c = tet(mesh, t);
        for (std::size_t i = 0; i < candidate_count; ++i) {
            if (contributions[t][i] != Contribution::hard) {
                continue;
            }
            const std::size_t entity = tet_candidates[i].entity;
            const std::size_t other = tet_candidates[i].other;
            if (i < edge_candidates) {
                pairs.add(regions.face[topology.tet_faces[t][entity]], regions.tet[t]);
            } else if (i < vertex_candidates) {
                pairs.add(regions.edge[topology.tet_edges[t][entity]], regions.face[topology.tet_faces[t][other]]);
            } else {
                pairs.add(regions.node[c[entity]], regions.edge[topology.tet_edges[t][other]]);
            }
        }
    }
    return pairs.take();
}

/// The block mesh as the dual of the dual: a node a region, an edge between regions that a hard contribution separates,
/// a hexahedron a dual point. Soft contributions are collapsed: dual points near one node of the mesh that no face
/// candidate separates are one. With valid classes the result is the midpoint subdivision of the CellComplex.
/// O(n); read-only and thread-safe.
template <tet_mesh M>
[[nodiscard]] DualBlocks dual_blocks(const M& mesh, const TetTopology& topology,
                                     const std::vector<TetContributions>& contributions, const Regions& regions) {
    DualBlocks out = detail::DualPointReader(mesh, topology, contributions, regions).run();
    out.edges = primal_edges(mesh, topology, contributions, regions);
    return out;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/contributions/dual_blocks-inl.hpp>
#endif
