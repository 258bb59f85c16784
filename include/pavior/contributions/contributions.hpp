#pragma once
/// \file
/// Local dual contributions of all tetrahedra, added hierarchically (Algorithms 5.2 to 5.5 \cite roca2009).
///
/// What this room is for: blocks without a prescribed mesh of the boundary, by looking at one tetrahedron at a time.
/// Each holds 28 candidate polygons (candidates.hpp) for pieces of the surfaces dual to the block mesh. From the
/// classes of its faces, edges and nodes alone, matching rules (matching_rules.hpp) choose those that are there: its
/// local dual contributions. Neighbours agree without asking each other, so that the pieces close to surfaces which
/// divide the solid into regions (regions.hpp; both to look at in dual_surfaces.hpp); a region is a node of the block
/// mesh, a dual point a hexahedron (dual_blocks.hpp). triangle_dual.hpp is all of it in the plane.
///
/// That block mesh is the midpoint subdivision of the cell complex that the layers cut out (dual/cell_complex.hpp),
/// which block_solid() takes by default since later steps need the complex anyway; with BlockOptions::dualization =
/// Dualization::contributions it takes what this room makes: the same bytes (tests/block/dualize_test.cpp).

#include <pavior/contributions/candidates.hpp>
#include <pavior/contributions/matching_rules.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior {

/// The contributions of one tetrahedron: two bits a candidate, candidate c at bits 2 c and 2 c + 1.
class TetContributions {
public:
    constexpr TetContributions() = default;
    [[nodiscard]] constexpr Contribution operator[](std::size_t candidate) const {
        return static_cast<Contribution>(bits_ >> 2 * candidate & 3U);
    }
    /// True if no candidate was added: the tetrahedron lies in one region.
    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
    /// True if some vertex candidate is hard: a dual point lies in the tetrahedron.
    [[nodiscard]] constexpr bool has_hard_vertex() const { return (bits_ & 0xAAAAAAULL << 2 * vertex_candidates) != 0; }
    /// True if some candidate is hard.
    [[nodiscard]] constexpr bool has_hard() const { return (bits_ & 0xAAAAAAAAAAAAAAULL) != 0; }
    /// Adds a candidate that was not yet added.
    constexpr void add(std::size_t candidate, Contribution type) {
        bits_ |= static_cast<std::uint64_t>(type) << 2 * candidate;
    }
    friend constexpr bool operator==(TetContributions, TetContributions) = default;

private:
    std::uint64_t bits_ = 0;
};

/// Algorithm 5.3 for one tetrahedron, given the classes of its faces.
constexpr void add_from_faces(const std::array<EntityClass, 4>& faces, TetContributions& out) {
    for (std::size_t f = 0; f < 4; ++f) {
        out.add(face_candidates + f, match_face(faces[f]));
    }
}

/// Algorithm 5.4 for one tetrahedron, given the classes of its edges.
constexpr void add_from_edges(const std::array<EntityClass, 6>& edges, TetContributions& out) {
    for (std::size_t e = 0; e < 6; ++e) {
        for (std::size_t s = 0; s < 2; ++s) {
            out.add(edge_candidates + 2 * e + s, match_edge(edges[e], out[face_candidates + edge_faces[e][s]]));
        }
    }
}

/// Algorithm 5.5 for one tetrahedron, given the classes of its nodes and edges.
constexpr void add_from_vertices(const std::array<EntityClass, 4>& nodes, const std::array<EntityClass, 6>& edges,
                                 VertexRule rule, TetContributions& out) {
    for (std::size_t e = 0; e < 6; ++e) {
        const Contribution first = out[edge_candidates + 2 * e];
        const Contribution second = out[edge_candidates + 2 * e + 1];
        for (std::size_t s = 0; s < 2; ++s) {
            const EntityClass node = nodes[static_cast<std::size_t>(tet_edges[e][s])];
            out.add(vertex_candidates + 2 * e + s, match_vertex(node, edges[e], first, second, rule));
        }
    }
}

/// Algorithm 5.2: one TetContributions a tetrahedron, 8 bytes each. Tetrahedra are independent of each other once the
/// classes are known, so that one pass does all three steps for each. O(n).
template <tet_mesh M>
[[nodiscard]] std::vector<TetContributions> add_contributions(const M& mesh, const TetTopology& topology,
                                                              const EntityClasses& classes,
                                                              VertexRule rule = VertexRule::repaired,
                                                              Execution execution = sequential) {
    std::vector<TetContributions> result(topology.tet_faces.size());
    parallel_for(execution, result.size(), 1024, [&](std::size_t begin, std::size_t end) {
        std::array<EntityClass, 4> nodes{};
        std::array<EntityClass, 6> edges{};
        std::array<EntityClass, 4> faces{};
        for (std::size_t t = begin; t < end; ++t) {
            const TetCorners c = tet(mesh, static_cast<Index>(t));
            bool free = true;
            for (std::size_t k = 0; k < 4; ++k) {
                nodes[k] = classes.node[c[k]];
                free = free && nodes[k] == EntityClass::free;
            }
            if (free) {
                continue;  // faces and edges of free nodes are free
            }
            for (std::size_t k = 0; k < 4; ++k) {
                faces[k] = classes.face[topology.tet_faces[t][k]];
            }
            for (std::size_t k = 0; k < 6; ++k) {
                edges[k] = classes.edge[topology.tet_edges[t][k]];
            }
            add_from_faces(faces, result[t]);
            add_from_edges(edges, result[t]);
            add_from_vertices(nodes, edges, rule, result[t]);
        }
    });
    return result;
}

}  // namespace pavior
