#pragma once
/// \file
/// Every tetrahedron as four hexahedra: the mesh that exists for every solid that has tetrahedra.

#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/dual/tet_topology.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// Tetrahedra split in four. Hexahedra 4 t + k are those of tetrahedron t, at its corner k.
///
///     c                0: corner                1, 3, 4: middles of the edges at it
///     | \              2, 5, 7: centroids of the triangles at it
///     3   2--          6: centroid of the tetrahedron
///     |  /   \         (here one triangle, a b c, of a tetrahedron a b c d, and the bottom 0 1 2 3 of the hexahedron
///     0---1---b        at a; the next corner of a triangle, seen from outside, follows on the one before)
struct SplitTets {
    /// Nodes: those of the tetrahedra with their ids, then middles of edges, centroids of triangles and centroids of
    /// tetrahedra, each in the order of the TetTopology.
    HexMesh mesh;
    /// Nodes of tetrahedra, edges, triangles, tetrahedra (0 to 3): first[d] .. first[d + 1] - 1.
    std::array<Index, 5> first{};
    /// Of given triangle i quads 3 i to 3 i + 2, one at each of its corners, turned as it: corner, middle of the edge
    /// that leaves it, centroid of the triangle, middle of the edge that comes to it.
    std::vector<QuadCorners> quads;
    std::vector<std::int32_t> quad_tags;  ///< of the triangle of each quad
    /// Of given edge i halves 2 i and 2 i + 1, from its first node to its middle, from there to its last node.
    std::vector<TaggedEdge> edges;

    /// The centroid of given triangle \p i, and the middle of given edge \p i.
    [[nodiscard]] Index triangle_node(std::size_t i) const { return quads[3 * i][2]; }
    [[nodiscard]] Index edge_node(std::size_t i) const { return edges[2 * i].nodes[1]; }
};

namespace detail {

/// Corner k and the other three so that they turn about it as 1, 2, 3 do about 0.
inline constexpr std::array<std::array<std::size_t, 4>, 4> tet_from_corner{
    {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};

/// The hexahedron of tetrahedron \p t with corners \p c at its corner \p k.
[[nodiscard]] inline HexCorners split_hex(const TetTopology& topology, const std::array<Index, 5>& first,
                                          const TetCorners& c, Index t, std::size_t k) {
    const auto& p = tet_from_corner[k];
    const auto middle = [&](std::size_t i) {
        return first[1] + topology.tet_edges[t][static_cast<std::size_t>(tet_edge_between[p[0]][p[i]])];
    };
    const auto opposite = [&](std::size_t i) { return first[2] + topology.tet_faces[t][p[i]]; };
    return {c[p[0]], middle(1), opposite(3), middle(2), middle(3), opposite(2), first[3] + t, opposite(1)};
}

/// Appends quads and halves of edges. \throws InputError bad_index
inline void split_tagged(const TetTopology& topology, std::span<const TaggedTriangle> triangles,
                         std::span<const TaggedEdge> edges, SplitTets& result) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const TriCorners& c = triangles[i].nodes;
        const Index face = topology.face(c);
        if (face == no_index) {
            throw InputError(ErrorCode::bad_index, "triangle " + std::to_string(i) + " is none of the tetrahedra",
                             {static_cast<std::int64_t>(i)});
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Index leaves = result.first[1] + topology.edge(c[k], c[(k + 1) % 3]);
            const Index comes = result.first[1] + topology.edge(c[(k + 2) % 3], c[k]);
            result.quads.push_back({c[k], leaves, result.first[2] + face, comes});
            result.quad_tags.push_back(triangles[i].tag);
        }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Index edge = topology.edge(edges[i].nodes[0], edges[i].nodes[1]);
        if (edge == no_index) {
            throw InputError(ErrorCode::bad_index, "edge " + std::to_string(i) + " is none of the tetrahedra",
                             {static_cast<std::int64_t>(i)});
        }
        result.edges.push_back({{edges[i].nodes[0], result.first[1] + edge}, edges[i].tag});
        result.edges.push_back({{result.first[1] + edge, edges[i].nodes[1]}, edges[i].tag});
    }
}

}  // namespace detail

/// Splits every tetrahedron of \p mesh at the middles of its edges and the centroids of its triangles and its own: the
/// dual with all contributions (section 5.4.3 \cite roca2009). The hexahedra conform, fill what the tetrahedra fill,
/// and are positive where these are. Of a regular tetrahedron they have a least scaled Jacobian of sqrt(1/2); in
/// general what counts is the solid angle that the least of the tetrahedra round a node leaves to its corner.
/// \param triangles,edges  faces and edges of the tetrahedra, boundary or not: their quads and halves inherit the tags
/// O(n), about 600 bytes a tetrahedron. The same bytes for any number of threads; thread-safe.
/// \throws InputError what tet_topology() throws; bad_index for a triangle or edge that is none of the tetrahedra, with
/// its number; overflow (2^32 nodes or more); Stopped
template <tet_mesh M>
[[nodiscard]] SplitTets split_tets(const M& mesh, std::span<const TaggedTriangle> triangles = {},
                                   std::span<const TaggedEdge> edges = {}, Execution execution = sequential) {
    const TetTopology topology = tet_topology(mesh, execution);
    const std::array<std::size_t, 4> counts{topology.node_count(), topology.edges.size(), topology.faces.size(),
                                            topology.tet_faces.size()};
    SplitTets result;
    std::size_t total = 0;
    for (std::size_t d = 0; d < 4; ++d) {
        total += counts[d];
        if (total >= std::numeric_limits<Index>::max()) {
            throw InputError(ErrorCode::overflow, "2^32 nodes or more");
        }
        result.first[d + 1] = static_cast<Index>(total);
    }
    std::vector<Vec3>& x = result.mesh.nodes;
    x.resize(total);
    result.mesh.hexes.resize(4 * counts[3]);
    constexpr std::size_t grain = 4096;
    const auto for_all = [&](std::size_t d, const auto& visit) {
        parallel_for(execution, counts[d], grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                visit(static_cast<Index>(i), x[result.first[d] + i]);
            }
        });
    };
    for_all(0, [&](Index i, Vec3& at) { at = node(mesh, i); });
    for_all(1, [&](Index e, Vec3& at) {
        const auto& c = topology.edges[e];
        at = (x[c[0]] + x[c[1]]) / 2.0;
    });
    for_all(2, [&](Index f, Vec3& at) {
        const auto& c = topology.faces[f];
        at = (x[c[0]] + x[c[1]] + x[c[2]]) / 3.0;
    });
    for_all(3, [&](Index t, Vec3& at) {
        const TetCorners c = tet(mesh, t);
        at = (x[c[0]] + x[c[1]] + x[c[2]] + x[c[3]]) / 4.0;
        for (std::size_t k = 0; k < 4; ++k) {
            result.mesh.hexes[std::size_t{4} * t + k] = detail::split_hex(topology, result.first, c, t, k);
        }
    });
    detail::split_tagged(topology, triangles, edges, result);
    return result;
}

/// The same for tetrahedra that bring their tags.
[[nodiscard]] inline SplitTets split_tets(const TaggedTetMesh& tets, Execution execution = sequential) {
    return split_tets(tets.mesh, tets.triangles, tets.edges, execution);
}

}  // namespace pavior
