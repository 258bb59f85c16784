#pragma once
/// \file
/// The conditions under which the cell complex of a reference mesh gives valid hexahedral blocks.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/detail/layer_fans.hpp>
#include <pavior/dual/dual_report.hpp>

#include <algorithm>
#include <cstdint>
#include <stop_token>
#include <vector>

namespace pavior {

namespace detail {

/// Collects the violations.
class DualVerifier {
public:
    DualVerifier(const TetTopology& topology, const EntityClasses& classes, const CellComplex& complex,
                 const std::stop_token& stop)
        : topology_(topology), classes_(classes), complex_(complex), stop_(stop), fans_(topology, classes, stop) {}

    DualReport run();

private:
    void add(DualFault fault, Index a, Index b = no_index, Index c = no_index) {
        report_.violations.push_back({fault, {a, b, c}});
    }

    void check_corners();

    void check_chains();

    void check_dangling_layers();

    /// Euler characteristic of each open patch: faces - layer edges + layer nodes; 1 for a disc.
    [[nodiscard]] std::vector<std::int64_t> patch_characteristics() const;

    void check_patches();

    void check_touching();

    /// A cell is a ball if its open stratum has characteristic -1 and its inner side one component.
    void check_cells();

    /// Components of the layer faces seen from inside each cell, joined across the edges between them.
    [[nodiscard]] std::vector<Index> inner_sides() const;

    /// From layer face \p f of tetrahedron \p t round \p edge through free faces to the next layer face.
    [[nodiscard]] Index turn(Index f, Index t, Index edge) const;

    void check_orphans();

    template <class T>
    static void sort_unique(std::vector<T>& values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    const TetTopology& topology_;
    const EntityClasses& classes_;
    const CellComplex& complex_;
    std::stop_token stop_;
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
/// One thread. O(n), apart from sorting the layer faces at stack edges; about 120 bytes a tetrahedron while it works.
/// \throws Stopped
template <tet_mesh M>
[[nodiscard]] DualReport verify_dual(const M& /*mesh*/, const TetTopology& topology, const EntityClasses& classes,
                                     const CellComplex& complex, const Execution& execution = sequential) {
    return detail::DualVerifier(topology, classes, complex, execution.stop).run();
}

/// The same with topology, classes and complex made on the way.
template <classified_tet_mesh M>
[[nodiscard]] DualReport verify_dual(const M& mesh) {
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    return verify_dual(mesh, topology, classes, cell_complex(mesh, topology, classes));
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/dual/verify_dual-inl.hpp>
#endif
