#pragma once
/// \file
/// Tetrahedra filed under their nodes, for tet_topology().

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/detail/check_tet.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Ranks nodes in the order in which the tetrahedra first touch them, nodes of no tetrahedron last. If neighbouring
/// tetrahedra stand close together in memory, then so do nodes of like rank, however the nodes are numbered.
template <tet_mesh M>
[[nodiscard]] std::vector<Index> rank_nodes(const M& mesh, const std::stop_token& stop = {}) {
    const std::size_t nodes = node_count(mesh);
    std::vector<Index> rank(nodes, no_index);
    Index count = 0;
    for (const Index t : stoppable(IndexRange(tet_count(mesh)), stop)) {
        const TetCorners c = tet(mesh, t);
        check_tet(c, t, nodes);
        for (const Index i : c) {
            if (rank[i] == no_index) {
                rank[i] = count++;
            }
        }
    }
    for (Index& r : rank) {
        r = r == no_index ? count++ : r;
    }
    return rank;
}

/// Calls body(piece, begin, end) for each of \p pieces equal parts of [0, count).
template <class Body>
void for_pieces(Execution execution, std::size_t pieces, std::size_t count, const Body& body) {
    parallel_for(execution, pieces, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            body(p, count * p / pieces, count * (p + 1) / pieces);
        }
    });
}

/// The tetrahedra with their corners in the order of ranks, filed under their lowest, second and third corner.
struct RankedTets {
    std::vector<std::array<Index, 4>> ranks;         ///< of the corners of each tetrahedron, ascending
    std::vector<std::array<std::uint8_t, 4>> local;  ///< local nodes in this order
    std::array<std::vector<Index>, 3> tets;          ///< by role: 0 lowest corner, 1 second, 2 third
    std::array<std::vector<Index>, 3> begin;         ///< first of each rank; nodes + 1
    std::vector<Index> node;                         ///< node of each rank
};

/// The corners of one tetrahedron in the order of ranks.
[[nodiscard]] constexpr std::array<std::uint64_t, 4> sorted_corners(const std::array<Index, 4>& ranks) {
    std::array<std::uint64_t, 4> key{};
    for (std::size_t k = 0; k < 4; ++k) {
        key[k] = std::uint64_t{ranks[k]} << 2U | k;
    }
    const auto order = [&](std::size_t i, std::size_t j) {
        const std::uint64_t low = std::min(key[i], key[j]);
        key[j] = std::max(key[i], key[j]);
        key[i] = low;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    return key;
}

/// Counts[piece][role][rank] become places of a counting sort.
inline void make_places(std::vector<std::array<std::vector<Index>, 3>>& counts, RankedTets& out) {
    for (std::size_t role = 0; role < 3; ++role) {
        Index at = 0;
        for (std::size_t r = 0; r + 1 < out.begin[role].size(); ++r) {
            for (auto& count : counts) {
                at += std::exchange(count[role][r], at);
            }
            out.begin[role][r + 1] = at;
        }
    }
}

template <tet_mesh M>
[[nodiscard]] RankedTets ranked_tets(const M& mesh, const std::vector<Index>& rank, Execution execution,
                                     std::size_t pieces) {
    const std::size_t nodes = rank.size();
    const std::size_t tets = tet_count(mesh);
    RankedTets out;
    out.ranks.resize(tets);
    out.local.resize(tets);
    out.node.resize(nodes);
    for (const Index i : IndexRange(nodes)) {
        out.node[rank[i]] = i;
    }
    for (std::size_t role = 0; role < 3; ++role) {
        out.tets[role].resize(tets);
        out.begin[role].assign(nodes + 1, 0);
    }
    std::vector<std::array<std::vector<Index>, 3>> places(pieces);
    for_pieces(execution, pieces, tets, [&](std::size_t p, std::size_t begin, std::size_t end) {
        for (std::vector<Index>& count : places[p]) {
            count.assign(nodes, 0);
        }
        for (const Index t :
             stoppable(IndexRange(static_cast<Index>(begin), static_cast<Index>(end)), execution.stop)) {
            const TetCorners c = tet(mesh, t);
            const auto sorted = sorted_corners({rank[c[0]], rank[c[1]], rank[c[2]], rank[c[3]]});
            for (std::size_t k = 0; k < 4; ++k) {
                out.ranks[t][k] = static_cast<Index>(sorted[k] >> 2U);
                out.local[t][k] = static_cast<std::uint8_t>(sorted[k] & 3U);
            }
            for (std::size_t role = 0; role < 3; ++role) {
                ++places[p][role][out.ranks[t][role]];
            }
        }
    });
    make_places(places, out);
    for_pieces(execution, pieces, tets, [&](std::size_t p, std::size_t begin, std::size_t end) {
        for (const Index t :
             stoppable(IndexRange(static_cast<Index>(begin), static_cast<Index>(end)), execution.stop)) {
            for (std::size_t role = 0; role < 3; ++role) {
                out.tets[role][places[p][role][out.ranks[t][role]]++] = t;
            }
        }
    });
    return out;
}

}  // namespace pavior::detail
