#pragma once

#include <pavior/core/stop.hpp>
#include <pavior/dual/verify_dual.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE DualReport DualVerifier::run() {
    check_corners();
    check_chains();
    check_dangling_layers();
    check_patches();
    check_touching();
    for (const Index i : fans_.pinched_nodes()) {
        add(DualFault::pinched_node, i);
    }
    check_cells();
    check_orphans();
    sort_unique(report_.violations);
    return std::move(report_);
}

PAVIOR_INLINE void DualVerifier::check_corners() {
    for (const CellCorner& corner : stoppable(std::span(complex_.corners), stop_)) {
        if (corner.rings != 1) {
            add(DualFault::corner_not_disc, corner.vertex, corner.cell, corner.rings);
        } else if (corner.valence != 3) {
            add(DualFault::corner_not_three_valent, corner.vertex, corner.cell, corner.valence);
        }
    }
}

PAVIOR_INLINE void DualVerifier::check_chains() {
    for (const Index c : stoppable(IndexRange(complex_.chains.size()), stop_)) {
        const auto [a, b] = complex_.chains[c].ends;
        const auto path = complex_.chain_path(c);
        if (a == no_index && b == no_index && path.front() == path.back()) {
            add(DualFault::chain_closed, c);
            continue;
        }
        if (a == b && a != no_index) {
            add(DualFault::chain_one_vertex, c, a);
        }
        if (a == no_index) {
            add(DualFault::chain_dangling, c, path.front());
        }
        if (b == no_index) {
            add(DualFault::chain_dangling, c, path.back());
        }
    }
}

PAVIOR_INLINE void DualVerifier::check_dangling_layers() {
    loose_.assign(complex_.patches.size(), 0);
    std::vector<Index> first(complex_.patches.size(), no_index);
    for (const Index f : stoppable(fans_.faces(), stop_)) {
        for (const Index e : topology_.face_edges[f]) {
            if (fans_.dangling(e)) {
                const Index p = complex_.face_patch[f];
                ++loose_[p];
                first[p] = std::min(first[p], e);
            }
        }
    }
    for (const Index p : IndexRange(loose_.size())) {
        if (loose_[p] != 0) {
            add(DualFault::dangling_layer, p, first[p], loose_[p]);
        }
    }
}

PAVIOR_INLINE std::vector<std::int64_t> DualVerifier::patch_characteristics() const {
    std::vector<std::int64_t> result(complex_.patches.size(), 0);
    std::vector<char> edge_seen(topology_.edges.size(), 0);
    std::vector<char> node_seen(topology_.node_count(), 0);
    for (const Index f : stoppable(fans_.faces(), stop_)) {
        std::int64_t& sum = result[complex_.face_patch[f]];
        ++sum;
        for (const Index e : topology_.face_edges[f]) {
            sum -= classes_.edge[e] == EntityClass::layer && std::exchange(edge_seen[e], 1) == 0 ? 1 : 0;
        }
        for (const Index i : topology_.faces[f]) {
            sum += classes_.node[i] == EntityClass::layer && std::exchange(node_seen[i], 1) == 0 ? 1 : 0;
        }
    }
    return result;
}

PAVIOR_INLINE void DualVerifier::check_patches() {
    const std::vector<std::int64_t> characteristic = patch_characteristics();
    for (const Index p : stoppable(IndexRange(complex_.patches.size()), stop_)) {
        if (loose_[p] != 0) {
            continue;
        }
        const Index loops = complex_.patch_loops[p + 1] - complex_.patch_loops[p];
        std::vector<Index> vertices;
        for (Index l = complex_.patch_loops[p]; l < complex_.patch_loops[p + 1]; ++l) {
            for (const PatchSide& side : complex_.loop(l)) {
                if (side.vertex != no_index) {
                    vertices.push_back(side.vertex);
                }
            }
        }
        if (characteristic[p] != 1 || loops != 1) {
            add(DualFault::patch_not_disc, p, loops);
        }
        if (vertices.size() < 3) {
            add(DualFault::patch_few_corners, p, static_cast<Index>(vertices.size()));
        }
        std::sort(vertices.begin(), vertices.end());
        for (auto at = vertices.begin(); (at = std::adjacent_find(at, vertices.end())) != vertices.end(); ++at) {
            add(DualFault::patch_touches_at_vertex, p, *at);
        }
    }
}

PAVIOR_INLINE void DualVerifier::check_touching() {
    std::vector<std::pair<Index, Index>> uses;  // stack edge, patch
    for (const Index f : stoppable(fans_.faces(), stop_)) {
        for (const Index e : topology_.face_edges[f]) {
            if (complex_.edge_chain[e] != no_index) {
                uses.emplace_back(e, complex_.face_patch[f]);
            }
        }
    }
    std::sort(uses.begin(), uses.end());
    for (auto at = uses.begin(); (at = std::adjacent_find(at, uses.end())) != uses.end(); ++at) {
        add(DualFault::patch_touches_along_chain, at->second, complex_.edge_chain[at->first]);
    }
}

PAVIOR_INLINE void DualVerifier::check_cells() {
    std::vector<std::int64_t> characteristic(complex_.cells.size(), 0);
    for (const Index cell : stoppable(std::span(complex_.tet_cell), stop_)) {
        --characteristic[cell];
    }
    std::vector<char> edge_seen(topology_.edges.size(), 0);
    std::vector<char> node_seen(topology_.node_count(), 0);
    for (const Index f : stoppable(IndexRange(topology_.faces.size()), stop_)) {
        const auto [t, other] = topology_.face_tets[f];
        std::int64_t& sum = characteristic[complex_.tet_cell[t]];
        if (classes_.face[f] == EntityClass::layer) {
            if (other != no_index && complex_.tet_cell[t] == complex_.tet_cell[other]) {
                add(DualFault::cell_on_both_sides, complex_.tet_cell[t], complex_.face_patch[f]);
            }
            continue;
        }
        ++sum;
        for (const Index e : topology_.face_edges[f]) {
            sum -= classes_.edge[e] == EntityClass::free && std::exchange(edge_seen[e], 1) == 0 ? 1 : 0;
        }
        for (const Index i : topology_.faces[f]) {
            sum += classes_.node[i] == EntityClass::free && std::exchange(node_seen[i], 1) == 0 ? 1 : 0;
        }
    }
    const std::vector<Index> sides = inner_sides();
    for (const Index c : IndexRange(characteristic.size())) {
        if (characteristic[c] != -1 || sides[c] != 1) {
            add(DualFault::cell_not_ball, c);
        }
    }
}

PAVIOR_INLINE std::vector<Index> DualVerifier::inner_sides() const {
    DisjointSets sides(2 * topology_.faces.size());
    for (const Index f : stoppable(fans_.faces(), stop_)) {
        for (const Index side : {0U, 1U}) {
            const Index t = topology_.face_tets[f][side];
            for (std::size_t k = 0; t != no_index && k < 3; ++k) {
                sides.unite(2 * f + side, turn(f, t, topology_.face_edges[f][k]));
            }
        }
    }
    std::vector<Index> count(complex_.cells.size(), 0);
    for (const Index f : stoppable(fans_.faces(), stop_)) {
        for (const Index side : {0U, 1U}) {
            const Index t = topology_.face_tets[f][side];
            if (t != no_index && sides.root(2 * f + side) == 2 * f + side) {
                ++count[complex_.tet_cell[t]];
            }
        }
    }
    return count;
}

PAVIOR_INLINE Index DualVerifier::turn(Index f, Index t, Index edge) const {
    while (true) {
        for (const Index g : topology_.tet_faces[t]) {
            const auto& e = topology_.face_edges[g];
            if (g != f && (e[0] == edge || e[1] == edge || e[2] == edge)) {
                f = g;
                break;
            }
        }
        if (classes_.face[f] == EntityClass::layer) {
            return 2 * f + (topology_.face_tets[f][0] == t ? 0U : 1U);
        }
        t = topology_.across(f, t);
    }
}

PAVIOR_INLINE void DualVerifier::check_orphans() {
    std::array<std::vector<char>, 4> used{
        std::vector<char>(complex_.vertices.size(), 0), std::vector<char>(complex_.chains.size(), 0),
        std::vector<char>(complex_.patches.size(), 0), std::vector<char>(complex_.cells.size(), 0)};
    for (const CellCorner& corner : stoppable(std::span(complex_.corners), stop_)) {
        if (corner.regular()) {
            used[0][corner.vertex] = used[3][corner.cell] = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                used[1][corner.chains[k]] = used[2][corner.patches[k]] = 1;
            }
        }
    }
    for (const Index dimension : {0U, 1U, 2U, 3U}) {
        for (const Index i : IndexRange(used[dimension].size())) {
            if (used[dimension][i] == 0) {
                add(DualFault::orphan, dimension, i);
            }
        }
    }
}

}  // namespace detail

}  // namespace pavior
