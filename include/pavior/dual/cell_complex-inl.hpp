#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/dual/cell_complex.hpp>

#include <algorithm>
#include <cstddef>
#include <stop_token>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void number_cells(const TetTopology& topology, const EntityClasses& classes, Execution execution,
                                CellComplex& out) {
    DisjointSets sets(topology.tet_faces.size());
    const bool shared = thread_count(execution) > 1;
    parallel_for(execution, topology.faces.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto [a, b] = topology.face_tets[f];
            if (classes.face[f] == EntityClass::free) {
                shared ? sets.unite_shared(a, b) : sets.unite(a, b);
            }
        }
    });
    const Index count = number_sets(sets, out.tet_cell, [](Index) { return true; });
    out.cells = first_members(out.tet_cell, count);
}

PAVIOR_INLINE void number_patches(const TetTopology& topology, const EntityClasses& classes,
                                  const std::stop_token& stop, CellComplex& out) {
    DisjointSets sets(topology.faces.size());
    std::vector<Index> first_of_edge(topology.edges.size(), no_index);
    std::vector<Index> first_of_node(topology.node_count(), no_index);
    const auto join = [&](Index f, Index& first) {
        first = first == no_index ? f : first;
        sets.unite(f, first);
    };
    for (const Index f : stoppable(IndexRange(topology.faces.size()), stop)) {
        if (classes.face[f] != EntityClass::layer) {
            continue;
        }
        for (const Index e : topology.face_edges[f]) {
            if (classes.edge[e] == EntityClass::layer) {
                join(f, first_of_edge[e]);
            }
        }
        for (const Index i : topology.faces[f]) {
            if (classes.node[i] == EntityClass::layer) {
                join(f, first_of_node[i]);
            }
        }
    }
    const Index count =
        number_sets(sets, out.face_patch, [&](Index f) { return classes.face[f] == EntityClass::layer; });
    out.patches = first_members(out.face_patch, count);
}

}  // namespace detail

}  // namespace pavior
