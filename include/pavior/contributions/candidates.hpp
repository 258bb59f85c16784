#pragma once
/// \file
/// The 28 candidate polygons of a tetrahedron, and their 28 points (section 5.4.3 and appendix C \cite roca2009).

#include <pavior/mesh/cells.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pavior {

/// Planes parallel to the faces, at barycentric distance mu from each, cut a tetrahedron into 15 pieces: four at the
/// nodes, six along the edges, four at the faces, one inside. The 28 polygons between them are the candidates. What the
/// planes draw on a face with nodes i < j < k (the same on every face of the mesh, so that neighbours match):
///
///                    k               points      12 on edges   2 e + s, near node s of edge e
///                   / \                          12 on faces   12 + 3 f + s, near the s-th of the ascending nodes of
///             p_ki +   + p_kj                                  face f
///                 / \ / \                         4 inside     24 + v, near node v
///                /   +   \           candidates   4 c(f; t)    f: between the piece at face f and the inner one, a
///               /   / \ p_kij                                  triangle of inner points
///              /   /   \   \                     12 c(e; f; t) 4 + 2 e + s: between the piece along edge e and that at
///        p_ik +---+-----+---+ p_jk                             its face edge_faces[e][s]
///            / p_ijk   p_jik \                   12 c(v; e; t) 16 + 2 e + s: between the piece at node s of edge e
///           /   /         \   \                                and that along the edge
///          i---+-----------+---j
///             p_ij        p_ji
///
/// Local numbers of nodes, edges and faces are those of mesh/cells.hpp: node k is v_(k+1), face k is opposite node k.
inline constexpr std::size_t candidate_count = 28;
/// Candidate of face f: face_candidates + f.
inline constexpr std::size_t face_candidates = 0;
/// Candidate of edge e and face edge_faces[e][s]: edge_candidates + 2 e + s.
inline constexpr std::size_t edge_candidates = 4;
/// Candidate of node tet_edges[e][s] and edge e: vertex_candidates + 2 e + s.
inline constexpr std::size_t vertex_candidates = 16;

/// Local faces of each edge of a tetrahedron, ascending.
inline constexpr std::array<std::array<std::size_t, 2>, 6> edge_faces{{{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};

/// Local nodes of each face of a tetrahedron, ascending.
inline constexpr std::array<std::array<std::size_t, 3>, 4> ascending_faces{
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

/// What a candidate comes from.
enum class CandidateKind : std::uint8_t { face, edge, vertex };

/// A candidate polygon of a tetrahedron.
struct Candidate {
    CandidateKind kind = CandidateKind::face;
    std::uint8_t entity = 0;  ///< local face, edge or node that the candidate separates from `other`
    std::uint8_t other = 0;   ///< edge candidates: local face; vertex candidates: local edge; face candidates: 0
    std::uint8_t size = 0;    ///< number of points, 3 or 4
    std::array<std::uint8_t, 4> points{};
};

/// The local point of edge \p e near node \p v.
[[nodiscard]] constexpr std::size_t edge_point(std::size_t e, std::size_t v) {
    return 2 * e + (static_cast<std::size_t>(tet_edges[e][0]) == v ? 0 : 1);
}
/// The local point of face \p f near node \p v.
[[nodiscard]] constexpr std::size_t face_point(std::size_t f, std::size_t v) {
    const auto& nodes = ascending_faces[f];
    return 12 + 3 * f + (nodes[0] == v ? 0 : nodes[1] == v ? 1 : 2);
}
/// The local point inside near node \p v.
[[nodiscard]] constexpr std::size_t inner_point(std::size_t v) { return 24 + v; }

/// Barycentric coordinates of local point \p point, for planes at distance 0 < mu < 1/4.
[[nodiscard]] constexpr std::array<double, 4> candidate_point(std::size_t point, double mu) {
    std::array<double, 4> lambda{};
    if (point < 12) {
        const auto& edge = tet_edges[point / 2];
        lambda[static_cast<std::size_t>(edge[point % 2])] = 1.0 - mu;
        lambda[static_cast<std::size_t>(edge[1 - point % 2])] = mu;
    } else if (point < 24) {
        for (const std::size_t v : ascending_faces[(point - 12) / 3]) {
            lambda[v] = mu;
        }
        lambda[ascending_faces[(point - 12) / 3][point % 3]] = 1.0 - 2.0 * mu;
    } else {
        lambda.fill(mu);
        lambda[point - 24] = 1.0 - 3.0 * mu;
    }
    return lambda;
}

namespace detail {
[[nodiscard]] constexpr Candidate make_candidate(CandidateKind kind, std::size_t entity, std::size_t other,
                                                 std::size_t size, std::array<std::size_t, 4> points) {
    Candidate c{
        kind, static_cast<std::uint8_t>(entity), static_cast<std::uint8_t>(other), static_cast<std::uint8_t>(size), {}};
    for (std::size_t i = 0; i < size; ++i) {
        c.points[i] = static_cast<std::uint8_t>(points[i]);
    }
    return c;
}

[[nodiscard]] constexpr std::array<Candidate, candidate_count> make_candidates() {
    std::array<Candidate, candidate_count> all{};
    for (std::size_t f = 0; f < 4; ++f) {
        const auto& n = ascending_faces[f];
        all[face_candidates + f] =
            make_candidate(CandidateKind::face, f, 0, 3, {inner_point(n[0]), inner_point(n[1]), inner_point(n[2]), 0});
    }
    for (std::size_t e = 0; e < 6; ++e) {
        const auto i = static_cast<std::size_t>(tet_edges[e][0]);
        const auto j = static_cast<std::size_t>(tet_edges[e][1]);
        for (std::size_t s = 0; s < 2; ++s) {
            const std::size_t f = edge_faces[e][s];
            all[edge_candidates + 2 * e + s] = make_candidate(
                CandidateKind::edge, e, f, 4, {face_point(f, i), face_point(f, j), inner_point(j), inner_point(i)});
            const std::size_t v = s == 0 ? i : j;
            all[vertex_candidates + 2 * e + s] = make_candidate(
                CandidateKind::vertex, v, e, 4,
                {edge_point(e, v), face_point(edge_faces[e][0], v), inner_point(v), face_point(edge_faces[e][1], v)});
        }
    }
    return all;
}
}  // namespace detail

/// All candidates of a tetrahedron; the points of each run round its polygon.
inline constexpr std::array<Candidate, candidate_count> tet_candidates = detail::make_candidates();

}  // namespace pavior
