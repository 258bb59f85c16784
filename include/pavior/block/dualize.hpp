#pragma once
/// \file
/// From a reference mesh and its classes to blocks: by its cell complex, or by its local dual contributions.

#include <pavior/block/block_mesh.hpp>
#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_blocks.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// The entity of the geometry on which nodes, edges and faces of a reference mesh lie.
template <classified_tet_mesh M>
class GeometryFinder {
public:
    GeometryFinder(const M& mesh, const TetTopology& topology)
        : topology_(topology),
          node_(topology.node_count()),
          edge_(topology.edges.size()),
          face_(topology.faces.size()) {
        for (const TaggedTriangle triangle : feature_access<M>::patches(mesh)) {
            const GeometryEntity patch{2, triangle.tag};
            if (const Index f = topology.face(triangle.nodes); f != no_index) {
                face_[f] = patch;
                for (std::size_t k = 0; k < 3; ++k) {
                    lower(edge_[topology.face_edges[f][k]], patch);
                    lower(node_[topology.faces[f][k]], patch);
                }
            }
        }
        for (const FeatureEdge edge : feature_access<M>::curves(mesh)) {
            const GeometryEntity curve{1, edge.curve};
            if (const Index e = topology.edge(edge.nodes[0], edge.nodes[1]); e != no_index) {
                lower(edge_[e], curve);
                lower(node_[edge.nodes[0]], curve);
                lower(node_[edge.nodes[1]], curve);
            }
        }
        for (const TaggedNode vertex : feature_access<M>::vertices(mesh)) {
            if (vertex.node < node_.size()) {
                node_[vertex.node] = {0, vertex.tag};
            }
        }
    }

    [[nodiscard]] GeometryEntity node(Index i) const { return node_[i]; }
    [[nodiscard]] GeometryEntity edge(Index e) const { return edge_[e]; }
    [[nodiscard]] GeometryEntity face(Index f) const { return face_[f]; }

private:
    /// Keeps the entity of lower dimension; the first one named among equals.
    static void lower(GeometryEntity& entity, const GeometryEntity& other) {
        entity = other.dimension < entity.dimension ? other : entity;
    }

    const TetTopology& topology_;
    std::vector<GeometryEntity> node_, edge_, face_;
};

PAVIOR_INLINE void require_regular(const CellCorner& corner);

/// Blocks over regions become blocks over block nodes, in the order of the corners of the cell complex: by vertex and
/// smallest tetrahedron, turned so that the smallest chain is corner 1.
[[nodiscard]] PAVIOR_INLINE std::vector<HexCorners> ordered_blocks(const Regions& regions, const DualBlocks& dual);

}  // namespace detail

/// The blocks of a solid: one node a vertex, chain, patch and cell of \p complex, one hexahedron a corner of a cell.
/// That is the midpoint subdivision of the complex, and what section 5.4.4 \cite roca2009 makes of the regions of the
/// dual surfaces. \p classes is what \p complex was made from.
/// \throws InputError invalid_dual for a corner that has not three chains, naming its vertex (of the complex), and for
/// three blocks on one quad; size_mismatch if the arguments are not of one mesh. Other violations (verify_dual.hpp)
/// may pass and lead to blocks that repeat nodes or share two quads: check first. O(n log n).
template <classified_tet_mesh M>
[[nodiscard]] BlockMesh dualize(const M& mesh, const TetTopology& topology, const EntityClasses& classes,
                                const CellComplex& complex) {
    if (topology.tet_faces.size() != tet_count(mesh) || classes.edge.size() != topology.edges.size() ||
        complex.node_vertex.size() != topology.node_count() || complex.tet_cell.size() != tet_count(mesh)) {
        throw InputError(ErrorCode::size_mismatch, "mesh, topology, classes and cell complex do not belong together");
    }
    const detail::GeometryFinder geometry(mesh, topology);
    std::vector<BlockNode> nodes;
    nodes.reserve(complex.cell_count());
    for (const Index v : IndexRange(complex.vertices.size())) {
        nodes.push_back({0, v, geometry.node(complex.vertices[v])});
    }
    for (const Index c : IndexRange(complex.chains.size())) {
        nodes.push_back({1, c, geometry.edge(complex.chains[c].edge)});
    }
    for (const Index p : IndexRange(complex.patches.size())) {
        nodes.push_back({2, p, geometry.face(complex.patches[p])});
    }
    for (const Index c : IndexRange(complex.cells.size())) {
        nodes.push_back({3, c, {3, 0}});
    }
    const auto chain = [&](Index id) { return static_cast<Index>(complex.vertices.size()) + id; };
    const auto patch = [&](Index id) { return chain(static_cast<Index>(complex.chains.size())) + id; };
    const auto cell = [&](Index id) { return patch(static_cast<Index>(complex.patches.size())) + id; };
    std::vector<HexCorners> hexes;
    hexes.reserve(complex.corners.size());
    for (const CellCorner& corner : complex.corners) {
        detail::require_regular(corner);
        const auto& c = corner.chains;
        const auto& p = corner.patches;
        hexes.push_back({corner.vertex, chain(c[0]), patch(p[0]), chain(c[1]), chain(c[2]), patch(p[2]),
                         cell(corner.cell), patch(p[1])});
    }
    return make_block_mesh(std::move(nodes), std::move(hexes));
}

/// The same from the local dual contributions, without a cell complex: one node a region, one hexahedron a dual point,
/// as section 5.4.4 \cite roca2009 has it. \p regions and \p dual are those of \p mesh. For classes that verify_dual()
/// accepts, the result is that of the cell complex: the same nodes and hexahedra in the same order.
/// \throws InputError invalid_dual for dual points whose regions form no hexahedron, and for three blocks on one quad;
/// bad_index if regions of the wrong kind meet; size_mismatch. O(n log n).
template <classified_tet_mesh M>
[[nodiscard]] BlockMesh dualize(const M& mesh, const TetTopology& topology, const Regions& regions,
                                const DualBlocks& dual) {
    if (topology.tet_faces.size() != tet_count(mesh) || regions.tet.size() != tet_count(mesh) ||
        regions.node.size() != topology.node_count() || dual.tet.size() != dual.blocks.size()) {
        throw InputError(ErrorCode::size_mismatch, "mesh, topology, regions and blocks do not belong together");
    }
    const detail::GeometryFinder geometry(mesh, topology);
    std::vector<BlockNode> nodes;
    nodes.reserve(regions.count());
    for (std::uint8_t dimension = 0; dimension < 4; ++dimension) {
        const Index first = regions.begin[3U - dimension];
        for (Index r = first; r < regions.begin[4U - dimension]; ++r) {
            const Index at = regions.representative[r];
            nodes.push_back({dimension, r - first,
                             dimension == 0   ? geometry.node(at)
                             : dimension == 1 ? geometry.edge(at)
                             : dimension == 2 ? geometry.face(at)
                                              : GeometryEntity{}});
        }
    }
    return make_block_mesh(std::move(nodes), detail::ordered_blocks(regions, dual));
}

/// The blocks of chapter 5 \cite roca2009 from the classes alone: contributions, regions, dual points, blocks.
/// \throws as dualize() of regions; overflow as regions(); Stopped. O(n log n); the same bytes for any number of
/// threads.
template <classified_tet_mesh M>
[[nodiscard]] BlockMesh dualize_contributions(const M& mesh, const TetTopology& topology, const EntityClasses& classes,
                                              const Execution& execution = sequential) {
    const auto contributions = add_contributions(mesh, topology, classes, VertexRule::repaired, execution);
    const Regions all = regions(mesh, topology, contributions, execution);
    check_stop(execution.stop);
    const DualBlocks dual = dual_blocks(mesh, topology, contributions, all);
    check_stop(execution.stop);
    return dualize(mesh, topology, all, dual);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/dualize-inl.hpp>
#endif
