#pragma once
/// \file
/// The cell complex that the layer faces cut the solid into. Its midpoint subdivision is what the local dual
/// contributions of chapter 5 \cite roca2009 compute: block nodes = cells of all dimensions, blocks = corners.

#include <pavior/core/compiled.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/detail/chain_tracer.hpp>
#include <pavior/dual/detail/corner_finder.hpp>
#include <pavior/dual/detail/loop_tracer.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

namespace pavior {

/// A 1-cell: a maximal run of stack edges.
struct Chain {
    Index edge = no_index;                          ///< its smallest edge
    std::array<Index, 2> ends{no_index, no_index};  ///< vertices; no_index: closed, or a dangling end
    friend bool operator==(const Chain&, const Chain&) = default;
};

/// One side of a patch: a chain, run through from `vertex`.
struct PatchSide {
    Index vertex = no_index;  ///< where the side starts; no_index on a closed chain and at a dangling layer edge
    Index chain = no_index;   ///< no_index along dangling layer edges
    bool reversed = false;    ///< runs against chain_path()
    friend bool operator==(const PatchSide&, const PatchSide&) = default;
};

/// A corner of a 3-cell: the tetrahedra round one vertex that no layer face separates. A block if it is regular.
struct CellCorner {
    Index vertex = no_index;
    Index cell = no_index;
    /// Seen from the vertex in positive order: det(c0, c1, c2) > 0 for the directions in which they leave it.
    std::array<Index, 3> chains{no_index, no_index, no_index};
    std::array<Index, 3> patches{no_index, no_index, no_index};  ///< patch k lies between chains k and k + 1 (mod 3)
    Index valence = 0;                                           ///< number of chains met going round
    Index rings = 0;                                             ///< closed rings of layer faces round the vertex
    Index tet = 0;                                               ///< its smallest tetrahedron

    [[nodiscard]] bool regular() const { return valence == 3 && rings == 1; }
    friend bool operator==(const CellCorner&, const CellCorner&) = default;
};

/// Vertices (0-cells: nodes of class hexahedron), chains (1-cells), patches (2-cells: layer faces joined across layer
/// edges and layer nodes) and cells (3-cells: tetrahedra joined across free faces). Each kind is numbered 0, 1, 2 ...
/// in the order of its smallest node, edge, face or tetrahedron.
struct CellComplex {
    std::vector<Index> node_vertex;  ///< vertex of each node, no_index if it is none
    std::vector<Index> edge_chain;   ///< chain of each edge, no_index if it is not of class stack
    std::vector<Index> face_patch;   ///< patch of each face, no_index if it is free
    std::vector<Index> tet_cell;     ///< cell of each tetrahedron

    std::vector<Index> vertices;  ///< node of each vertex
    std::vector<Chain> chains;
    std::vector<Index> patches;  ///< smallest face of each patch
    std::vector<Index> cells;    ///< smallest tetrahedron of each cell

    std::vector<Index> chain_nodes;      ///< nodes of the chains, one chain after the other
    std::vector<Index> chain_begin{0};   ///< chains + 1
    std::vector<PatchSide> patch_sides;  ///< sides of the loops, one loop after the other
    std::vector<Index> loop_begin{0};    ///< first side of each loop; loops + 1
    std::vector<Index> patch_loops{0};   ///< first loop of each patch; patches + 1
    std::vector<CellCorner> corners;     ///< ascending by vertex, then tetrahedron

    /// Nodes along \p chain from end 0 to end 1; a closed chain repeats its first node.
    [[nodiscard]] std::span<const Index> chain_path(Index chain) const {
        return std::span(chain_nodes).subspan(chain_begin[chain], chain_begin[chain + 1] - chain_begin[chain]);
    }
    /// Sides of boundary loop \p loop; the loops of patch p are patch_loops[p] .. patch_loops[p + 1] - 1, one for a
    /// disc. A patch on the boundary of the solid is run round counter-clockwise seen from outside; an inner one
    /// counter-clockwise seen from the second tetrahedron of the smallest face on the loop.
    [[nodiscard]] std::span<const PatchSide> loop(Index loop) const {
        return std::span(patch_sides).subspan(loop_begin[loop], loop_begin[loop + 1] - loop_begin[loop]);
    }
    /// Number of block nodes: cells of all dimensions.
    [[nodiscard]] std::size_t cell_count() const {
        return vertices.size() + chains.size() + patches.size() + cells.size();
    }
};

namespace detail {

PAVIOR_INLINE void number_cells(const TetTopology& topology, const EntityClasses& classes, Execution execution,
                                CellComplex& out);

PAVIOR_INLINE void number_patches(const TetTopology& topology, const EntityClasses& classes,
                                  const std::stop_token& stop, CellComplex& out);

}  // namespace detail

/// The cell complex of \p mesh with these classes. It is made for any classes, valid or not: verify_dual() judges it.
/// O(n); the same bytes for any number of threads. \throws Stopped
template <tet_mesh M>
[[nodiscard]] CellComplex cell_complex(const M& mesh, const TetTopology& topology, const EntityClasses& classes,
                                       Execution execution = sequential) {
    CellComplex out;
    out.node_vertex.assign(topology.node_count(), no_index);
    for (const Index i : stoppable(IndexRange(topology.node_count()), execution.stop)) {
        if (classes.node[i] == EntityClass::hexahedron) {
            out.node_vertex[i] = static_cast<Index>(out.vertices.size());
            out.vertices.push_back(i);
        }
    }
    detail::number_cells(topology, classes, execution, out);
    detail::number_patches(topology, classes, execution.stop, out);
    detail::ChainTracer(topology, classes, out).run(execution.stop);
    detail::LoopTracer(mesh, topology, classes, out).run(execution.stop);
    detail::CornerFinder(mesh, topology, classes, out).run(execution.stop);
    return out;
}

#ifdef PAVIOR_COMPILED
extern template CellComplex cell_complex<ReferenceMesh>(const ReferenceMesh&, const TetTopology&, const EntityClasses&,
                                                        Execution);
#endif

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/dual/cell_complex-inl.hpp>
#endif
