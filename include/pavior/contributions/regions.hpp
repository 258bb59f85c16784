#pragma once
/// \file
/// The regions into which the local dual contributions divide the solid: nodes of the block mesh.

#include <pavior/contributions/contributions.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/parallel_for.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pavior {

/// Regions of the 15 pieces of all tetrahedra. Nothing ever separates the pieces of one node, edge or face in
/// neighbouring tetrahedra, so that one id a node, edge, face and tetrahedron names them all.
struct Regions {
    std::vector<Index> tet;   ///< region of the inner piece of each tetrahedron
    std::vector<Index> face;  ///< region of the two pieces at each face
    std::vector<Index> edge;  ///< region of the pieces along each edge
    std::vector<Index> node;  ///< region of the pieces at each node; no_index at a node of no tetrahedron
    /// Regions by what they come from: begin[0] .. begin[1] - 1 hold a tetrahedron, begin[1] .. begin[2] - 1 at most
    /// a face, begin[2] .. begin[3] - 1 at most an edge, begin[3] .. begin[4] - 1 a node alone.
    std::array<Index, 5> begin{};
    std::vector<Index> representative;  ///< the smallest such tetrahedron, face, edge or node of each region

    [[nodiscard]] Index count() const { return begin[4]; }
    /// 3 for a region that comes from a cell, 2 from a patch, 1 from a chain, 0 from a vertex.
    [[nodiscard]] int dimension(Index region) const {
        return region < begin[1] ? 3 : region < begin[2] ? 2 : region < begin[3] ? 1 : 0;
    }
    friend bool operator==(const Regions&, const Regions&) = default;
};

namespace detail {

/// Members of the sets: tetrahedra, then faces, edges, nodes.
struct PieceIds {
    explicit PieceIds(const TetTopology& topology)
        : faces(topology.tet_faces.size()),
          edges(faces + topology.faces.size()),
          nodes(edges + topology.edges.size()),
          end(nodes + topology.node_count()) {}
    std::size_t faces;
    std::size_t edges;
    std::size_t nodes;
    std::size_t end;
};

/// Joins pieces, for one thread. The set of the inner piece of a tetrahedron is kept at hand.
class PieceJoiner {
public:
    explicit PieceJoiner(DisjointSets<>& sets) : sets_(sets) {}
    void start(Index tet) { root_ = sets_.root(tet); }
    void attach(Index piece) { root_ = sets_.attach(piece, root_); }
    void unite(Index a, Index b) {
        sets_.unite(a, b);
        root_ = sets_.root(root_);
    }

private:
    DisjointSets<>& sets_;
    Index root_ = 0;
};

/// The same for any number of threads.
class SharedPieceJoiner {
public:
    explicit SharedPieceJoiner(DisjointSets<>& sets) : sets_(sets) {}
    void start(Index tet) { tet_ = tet; }
    void attach(Index piece) { sets_.unite_shared(piece, tet_); }
    void unite(Index a, Index b) { sets_.unite_shared(a, b); }

private:
    DisjointSets<>& sets_;
    Index tet_ = 0;
};

/// Joins the pieces of tetrahedron t across candidates that were not added. Pieces that hang together with the inner
/// one already are left alone.
template <class Joiner>
void join_pieces_of(const TetCorners& corners, const TetTopology& topology, TetContributions contributions, Index t,
                    const PieceIds& ids, Joiner& join) {
    const auto face = [&](std::size_t k) { return static_cast<Index>(ids.faces + topology.tet_faces[t][k]); };
    const auto edge = [&](std::size_t k) { return static_cast<Index>(ids.edges + topology.tet_edges[t][k]); };
    const auto node = [&](std::size_t k) { return static_cast<Index>(ids.nodes + corners[k]); };
    const auto absent = [&](std::size_t candidate) { return contributions[candidate] == Contribution::none; };
    std::array<bool, 4> face_in{};
    std::array<bool, 6> edge_in{};
    std::array<bool, 4> node_in{};
    const auto unite = [&](bool& low_in, Index low, bool high_in, Index high) {
        if (high_in && !low_in) {
            join.attach(low);
            low_in = true;
        } else if (!high_in) {
            join.unite(low, high);
        }
    };
    join.start(t);
    for (std::size_t f = 0; f < 4; ++f) {
        if (absent(face_candidates + f)) {
            join.attach(face(f));
            face_in[f] = true;
        }
    }
    for (std::size_t e = 0; e < 6; ++e) {
        for (std::size_t s = 0; s < 2; ++s) {
            if (absent(edge_candidates + 2 * e + s)) {
                unite(edge_in[e], edge(e), face_in[edge_faces[e][s]], face(edge_faces[e][s]));
            }
        }
        for (std::size_t s = 0; s < 2; ++s) {
            if (absent(vertex_candidates + 2 * e + s)) {
                const auto v = static_cast<std::size_t>(tet_edges[e][s]);
                unite(node_in[v], node(v), edge_in[e], edge(e));
            }
        }
    }
}

/// The same where no candidate was added.
template <class Joiner>
void join_all_pieces_of(const TetCorners& corners, const TetTopology& topology, Index t, const PieceIds& ids,
                        Joiner& join) {
    join.start(t);
    for (std::size_t k = 0; k < 4; ++k) {
        join.attach(static_cast<Index>(ids.faces + topology.tet_faces[t][k]));
    }
    for (std::size_t k = 0; k < 6; ++k) {
        join.attach(static_cast<Index>(ids.edges + topology.tet_edges[t][k]));
    }
    for (std::size_t k = 0; k < 4; ++k) {
        join.attach(static_cast<Index>(ids.nodes + corners[k]));
    }
}

template <class Joiner, tet_mesh M>
void join_pieces(const M& mesh, const TetTopology& topology, const std::vector<TetContributions>& contributions,
                 const PieceIds& ids, std::size_t begin, std::size_t end, Joiner join) {
    for (std::size_t i = begin; i < end; ++i) {
        const auto t = static_cast<Index>(i);
        if (contributions[i].empty()) {
            join_all_pieces_of(tet(mesh, t), topology, t, ids, join);
        } else {
            join_pieces_of(tet(mesh, t), topology, contributions[i], t, ids, join);
        }
    }
}

PAVIOR_INLINE void number_regions(const TetTopology& topology, const PieceIds& ids, DisjointSets<>& sets, Regions& out);

}  // namespace detail

/// Joins the 15 pieces of each tetrahedron across candidates that were not added, and pieces of neighbouring tetrahedra
/// across their common face. Regions are numbered in the order of their representatives, those of tetrahedra first,
/// so that with valid classes region i is cell i, and patches, chains and vertices of the CellComplex follow in this
/// order. All tetrahedra round a node or an edge must be neighbours across faces (else the pieces are joined all the
/// same). No polyhedron is built: 4 bytes a node, edge, face and tetrahedron, and as much again while it works; O(n);
/// the same bytes for any number of threads.
/// \throws InputError overflow (2^32 nodes, edges, faces and tetrahedra or more)
template <tet_mesh M>
[[nodiscard]] Regions regions(const M& mesh, const TetTopology& topology,
                              const std::vector<TetContributions>& contributions, Execution execution = sequential) {
    const detail::PieceIds ids(topology);
    if (ids.end >= no_index) {
        throw InputError(ErrorCode::overflow, "2^32 pieces or more: " + std::to_string(ids.end));
    }
    DisjointSets sets(ids.end);
    const bool shared = thread_count(execution) > 1;
    parallel_for(execution, contributions.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (shared) {
            detail::join_pieces(mesh, topology, contributions, ids, begin, end, detail::SharedPieceJoiner(sets));
        } else {
            detail::join_pieces(mesh, topology, contributions, ids, begin, end, detail::PieceJoiner(sets));
        }
    });
    Regions out;
    detail::number_regions(topology, ids, sets, out);
    return out;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/contributions/regions-inl.hpp>
#endif
