#pragma once
/// \file
/// The conditions under which the cell complex of a reference mesh gives valid hexahedral blocks.

#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/detail/layer_fans.hpp>
#include <pavior/dual/dual_report.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Collects the violations.
class DualVerifier {
public:
    DualVerifier(const TetTopology& topology, const EntityClasses& classes, const CellComplex& complex)
        : topology_(topology), classes_(classes), complex_(complex), fans_(topology, classes) {}

    DualReport run() {
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

private:
    void add(DualFault fault, Index a, Index b = no_index, Index c = no_index) {
        report_.violations.push_back({fault, {a, b, c}});
    }

    void check_corners() {
        for (const CellCorner& corner : complex_.corners) {
            if (corner.rings != 1) {
                add(DualFault::corner_not_disc, corner.vertex, corner.cell, corner.rings);
            } else if (corner.valence != 3) {
                add(DualFault::corner_not_three_valent, corner.vertex, corner.cell, corner.valence);
            }
        }
    }

    void check_chains() {
        for (const Index c : IndexRange(complex_.chains.size())) {
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

    void check_dangling_layers() {
        loose_.assign(complex_.patches.size(), 0);
        std::vector<Index> first(complex_.patches.size(), no_index);
        for (const Index f : fans_.faces()) {
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

    /// Euler characteristic of each open patch: faces - layer edges + layer nodes; 1 for a disc.
    [[nodiscard]] std::vector<std::int64_t> patch_characteristics() const {
        std::vector<std::int64_t> result(complex_.patches.size(), 0);
        std::vector<char> edge_seen(topology_.edges.size(), 0);
        std::vector<char> node_seen(topology_.node_count(), 0);
        for (const Index f : fans_.faces()) {
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

    void check_patches() {
        const std::vector<std::int64_t> characteristic = patch_characteristics();
        for (const Index p : IndexRange(complex_.patches.size())) {
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

    void check_touching() {
        std::vector<std::pair<Index, Index>> uses;  // stack edge, patch
        for (const Index f : fans_.faces()) {
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

    /// A cell is a ball if its open stratum has characteristic -1 and its inner side one component.
    void check_cells() {
        std::vector<std::int64_t> characteristic(complex_.cells.size(), 0);
        for (const Index cell : complex_.tet_cell) {
            --characteristic[cell];
        }
        std::vector<char> edge_seen(topology_.edges.size(), 0);
        std::vector<char> node_seen(topology_.node_count(), 0);
        for (const Index f : IndexRange(topology_.faces.size())) {
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

    /// Components of the layer faces seen from inside each cell, joined across the edges between them.
    [[nodiscard]] std::vector<Index> inner_sides() const {
        IndexSets sides(2 * topology_.faces.size());
        for (const Index f : fans_.faces()) {
            for (const Index side : {0U, 1U}) {
                const Index t = topology_.face_tets[f][side];
                for (std::size_t k = 0; t != no_index && k < 3; ++k) {
                    sides.unite(2 * f + side, turn(f, t, topology_.face_edges[f][k]));
                }
            }
        }
        std::vector<Index> count(complex_.cells.size(), 0);
        for (const Index f : fans_.faces()) {
            for (const Index side : {0U, 1U}) {
                const Index t = topology_.face_tets[f][side];
                if (t != no_index && sides.root(2 * f + side) == 2 * f + side) {
                    ++count[complex_.tet_cell[t]];
                }
            }
        }
        return count;
    }

    /// From layer face \p f of tetrahedron \p t round \p edge through free faces to the next layer face.
    [[nodiscard]] Index turn(Index f, Index t, Index edge) const {
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

    void check_orphans() {
        std::array<std::vector<char>, 4> used{
            std::vector<char>(complex_.vertices.size(), 0), std::vector<char>(complex_.chains.size(), 0),
            std::vector<char>(complex_.patches.size(), 0), std::vector<char>(complex_.cells.size(), 0)};
        for (const CellCorner& corner : complex_.corners) {
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

    template <class T>
    static void sort_unique(std::vector<T>& values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    const TetTopology& topology_;
    const EntityClasses& classes_;
    const CellComplex& complex_;
    LayerFans fans_;
    std::vector<Index> loose_;  ///< dangling edges of each patch
    DualReport report_;
};
}  // namespace detail

/// Checks whether the corners of \p complex are valid blocks, and names every violation:
/// 1. every chain has two different vertices at its ends;
/// 2. every patch is an open disc with three corners or more that does not touch itself, and no layer edge has exactly
///    one layer face;
/// 3. every cell is an open ball that does not lie on both sides of a patch;
/// 4. every corner of every cell meets exactly three chains;
/// 5. every vertex, chain, patch and cell belongs to a block.
/// Discs and balls are recognised by counting: by the Euler characteristic of the open stratum and the number of pieces
/// of its rim. \p topology, \p classes and \p complex belong to \p mesh, which lies in space without overlap.
/// O(n), apart from sorting the layer faces at stack edges; about 120 bytes a tetrahedron while it works.
template <tet_mesh M>
[[nodiscard]] DualReport verify_dual(const M& /*mesh*/, const TetTopology& topology, const EntityClasses& classes,
                                     const CellComplex& complex) {
    return detail::DualVerifier(topology, classes, complex).run();
}

/// The same with topology, classes and complex made on the way.
template <classified_tet_mesh M>
[[nodiscard]] DualReport verify_dual(const M& mesh) {
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    return verify_dual(mesh, topology, classes, cell_complex(mesh, topology, classes));
}

}  // namespace pavior
