#pragma once
/// \file
/// The edges and faces of a tetrahedral mesh: flat arrays, no hashing.

#include <pavior/core/parallel_for.hpp>
#include <pavior/dual/detail/topology_pieces.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pavior {

/// Edges and faces of T tetrahedra. Nodes have ranks: the order in which the tetrahedra first touch them. An edge or
/// face is filed under its node of lowest rank; among those of one node the ranks of the next nodes decide.
struct TetTopology {
    std::vector<std::array<Index, 2>> edges;       ///< E x 2 nodes, ascending
    std::vector<TriCorners> faces;                 ///< F x 3 nodes, ascending
    std::vector<std::array<Index, 6>> tet_edges;   ///< T x 6 edges, in the order of pavior::tet_edges
    std::vector<std::array<Index, 4>> tet_faces;   ///< T x 4 faces, face k opposite node k
    std::vector<std::array<Index, 3>> face_edges;  ///< F x 3 edges, edge k opposite node k of the face
    std::vector<std::array<Index, 2>> face_tets;   ///< F x 2 tetrahedra, ascending; the second no_index on the boundary
    std::vector<Index> node_rank;                  ///< rank of each node
    std::vector<Index> edge_begin;                 ///< edges filed under rank r: edge_begin[r] .. edge_begin[r + 1] - 1
    std::vector<Index> face_begin;                 ///< the same for faces

    [[nodiscard]] std::size_t node_count() const { return node_rank.size(); }
    [[nodiscard]] bool boundary(Index face) const { return face_tets[face][1] == no_index; }
    /// The other tetrahedron on \p face of \p tet; no_index on the boundary.
    [[nodiscard]] Index across(Index face, Index tet) const {
        return face_tets[face][0] == tet ? face_tets[face][1] : face_tets[face][0];
    }
    /// The edge between two nodes in any order, no_index if there is none. O(log degree).
    [[nodiscard]] Index edge(Index a, Index b) const { return find(edges, edge_begin, std::array<Index, 2>{a, b}); }
    /// The face on three nodes in any order, no_index if there is none. O(log degree).
    [[nodiscard]] Index face(const TriCorners& nodes) const { return find(faces, face_begin, nodes); }

    friend bool operator==(const TetTopology&, const TetTopology&) = default;

private:
    template <std::size_t N>
    [[nodiscard]] std::array<Index, N> ranks(std::array<Index, N> nodes) const {
        std::transform(nodes.begin(), nodes.end(), nodes.begin(), [&](Index i) { return node_rank[i]; });
        std::sort(nodes.begin(), nodes.end());
        return nodes;
    }
    template <std::size_t N>
    [[nodiscard]] Index find(const std::vector<std::array<Index, N>>& cells, const std::vector<Index>& begin,
                             const std::array<Index, N>& nodes) const {
        if (std::any_of(nodes.begin(), nodes.end(), [&](Index i) { return i >= node_count(); })) {
            return no_index;
        }
        const std::array<Index, N> wanted = ranks(nodes);
        const auto first = cells.begin() + begin[wanted[0]];
        const auto last = cells.begin() + begin[wanted[0] + std::size_t{1}];
        const auto at =
            std::lower_bound(first, last, wanted, [&](const auto& cell, const auto& key) { return ranks(cell) < key; });
        return at != last && ranks(*at) == wanted ? static_cast<Index>(at - cells.begin()) : no_index;
    }
};

namespace detail {

/// Local face \p k of a tetrahedron, counter-clockwise seen from outside.
[[nodiscard]] constexpr TriCorners tet_face(const TetCorners& c, std::size_t k) {
    const auto& local = tet_faces[k];
    return {c[static_cast<std::size_t>(local[0])], c[static_cast<std::size_t>(local[1])],
            c[static_cast<std::size_t>(local[2])]};
}

/// The local face of tetrahedron \p t that is \p face.
[[nodiscard]] inline std::size_t local_face(const TetTopology& topology, Index t, Index face) {
    const auto& f = topology.tet_faces[t];
    return f[0] == face ? 0 : f[1] == face ? 1 : f[2] == face ? 2 : 3;
}
}  // namespace detail

/// Numbers the edges and faces of \p mesh. O(n), apart from sorting the few edges and faces of each node; 120 bytes a
/// tetrahedron for the result and 40 more while it is made; the same bytes for any number of threads. Twice as fast
/// where neighbouring tetrahedra stand close together in memory (spatial_order.hpp), however the nodes are numbered.
/// \throws InputError bad_index (tetrahedron with an unknown node or one node twice; its id), non_manifold (triangle of
///         three tetrahedra; its nodes), overflow (2^30 tetrahedra or more); Stopped
template <tet_mesh M>
[[nodiscard]] TetTopology tet_topology(const M& mesh, Execution execution = sequential) {
    const std::size_t nodes = node_count(mesh);
    const std::size_t tets = tet_count(mesh);
    if (tets >= std::size_t{1} << 30U) {
        throw InputError(ErrorCode::overflow, "2^30 tetrahedra or more: " + std::to_string(tets));
    }
    TetTopology out;
    out.node_rank = detail::rank_nodes(mesh, execution.stop);
    const std::size_t pieces = std::clamp<std::size_t>(tets / 4096, 1, thread_count(execution));
    const detail::RankedTets ranked = detail::ranked_tets(mesh, out.node_rank, execution, pieces);
    out.tet_edges.resize(tets);
    out.tet_faces.resize(tets);
    out.edge_begin.assign(nodes + 1, 0);
    out.face_begin.assign(nodes + 1, 0);
    const std::vector<std::size_t> cuts = detail::balanced_cuts(ranked, pieces);
    std::vector<detail::TopologyPiece<TetTopology>> parts(pieces, {ranked, out});
    detail::for_pieces(execution, pieces, pieces, [&](std::size_t p, std::size_t, std::size_t) {
        parts[p].run(cuts[p], cuts[p + 1], execution.stop);
    });
    detail::join_topology_pieces(ranked, parts, cuts, out, execution);
    detail::finish_face_edges(out, execution);
    return out;
}

}  // namespace pavior
