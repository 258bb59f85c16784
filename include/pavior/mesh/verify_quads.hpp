#pragma once
/// \file
/// Checks of quad meshes: everything that the compiler cannot see in the concept quad_mesh.

#include <pavior/core/compiled.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/verify_report.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pavior {

/// Options of verify_quads().
struct VerifyQuadsOptions {
    std::size_t cap = 16;             ///< offenders of a kind whose ids are kept
    bool allow_unused_nodes = false;  ///< true: nodes of no quad are no fault
    /// Components that are no fault; default: any number. 1: the mesh must be connected.
    std::size_t max_components = std::numeric_limits<std::size_t>::max();
};

/// Result of verify_quads().
struct QuadReport : VerifyReport {
    using VerifyReport::VerifyReport;
    std::size_t components = 0;      ///< sets of quads that hang together by edges
    std::size_t boundary_edges = 0;  ///< edges of one quad
};

namespace detail {

template <vertex_mesh M>
void check_finite(const M& mesh, VerifyReport& report) {
    for (const Index i : IndexRange(node_count(mesh))) {
        if (!node(mesh, i).allFinite()) {
            report.add(MeshFault::not_finite, {i});
        }
    }
}

/// 1 for cells that must be left out of further checks.
template <std::size_t N>
[[nodiscard]] bool has_repeats(std::array<Index, N> corners) {
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
}

template <quad_mesh M>
[[nodiscard]] std::vector<char> check_corners(const M& mesh, QuadReport& report) {
    const std::size_t nodes = node_count(mesh);
    std::vector<char> bad(quad_count(mesh), 0);
    for (const Index q : IndexRange(bad.size())) {
        const QuadCorners c = quad(mesh, q);
        if (std::any_of(c.begin(), c.end(), [&](Index i) { return i >= nodes; })) {
            report.add(MeshFault::id_out_of_range, {q});
            bad[q] = 1;
        } else if (has_repeats(c)) {
            report.add(MeshFault::repeated_node, {q});
            bad[q] = 1;
        }
    }
    return bad;
}

/// Marks quads on the four nodes of an earlier one as bad.
template <quad_mesh M>
void check_duplicates(const M& mesh, std::vector<char>& bad, QuadReport& report) {
    std::vector<std::pair<QuadCorners, Index>> keys;
    keys.reserve(bad.size());
    for (const Index q : IndexRange(bad.size())) {
        if (bad[q] == 0) {
            QuadCorners c = quad(mesh, q);
            std::sort(c.begin(), c.end());
            keys.emplace_back(c, q);
        }
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Index> duplicates;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].first == keys[i - 1].first) {
            duplicates.push_back(keys[i].second);
        }
    }
    std::sort(duplicates.begin(), duplicates.end());
    for (const Index q : duplicates) {
        report.add(MeshFault::duplicate_cell, {q});
        bad[q] = 1;
    }
}

[[nodiscard]] inline std::size_t corner_at(const QuadCorners& corners, Index node) {
    return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), node) - corners.begin());
}

/// Checks the edges; joins the quads and the corners of quads that share one.
template <quad_mesh M>
void check_edges(const M& mesh, const std::vector<char>& bad, QuadReport& report, DisjointSets<>& quads,
                 DisjointSets<std::size_t>& corners) {
    EdgeTable(mesh, bad).for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
        const Index q = uses[0].quad;
        const QuadCorners c = quad(mesh, uses[0].quad);
        for (const EdgeTable::Use& use : uses.subspan(1)) {
            const QuadCorners d = quad(mesh, use.quad);
            quads.unite(q, use.quad);
            for (const Index end : {low, high}) {
                corners.unite(4 * std::size_t{q} + corner_at(c, end), 4 * std::size_t{use.quad} + corner_at(d, end));
            }
        }
        report.boundary_edges += uses.size() == 1 ? 1U : 0U;
        if (uses.size() > 2) {
            report.add(MeshFault::overused, {low, high});
        } else if (uses.size() == 2 && runs_along(c, low, high) == runs_along(quad(mesh, uses[1].quad), low, high)) {
            report.add(MeshFault::same_sense, {low, high});
        }
    });
}

/// Unused nodes, and nodes whose corners fall into two or more sets.
template <quad_mesh M>
void check_nodes(const M& mesh, const std::vector<char>& bad, const VerifyQuadsOptions& options, QuadReport& report,
                 DisjointSets<std::size_t>& corners) {
    const std::size_t nodes = node_count(mesh);
    std::vector<unsigned char> sheets(nodes, 0);
    std::vector<char> used(nodes, 0);
    for (const Index q : IndexRange(bad.size())) {
        const QuadCorners c = quad(mesh, q);
        for (std::size_t k = 0; k < 4; ++k) {
            if (c[k] < nodes) {
                used[c[k]] = 1;
                const std::size_t at = 4 * std::size_t{q} + k;
                const bool root = bad[q] == 0 && corners.root(at) == at;
                sheets[c[k]] = static_cast<unsigned char>(std::min(2, sheets[c[k]] + (root ? 1 : 0)));
            }
        }
    }
    for (const Index i : IndexRange(nodes)) {
        if (sheets[i] > 1) {
            report.add(MeshFault::touching_sheets, {i});
        }
        if (used[i] == 0 && !options.allow_unused_nodes) {
            report.add(MeshFault::unused_node, {i});
        }
    }
}

PAVIOR_INLINE void check_components(const std::vector<char>& bad, const VerifyQuadsOptions& options, QuadReport& report,
                                    DisjointSets<>& quads);

}  // namespace detail

/// Checks \p mesh and lists every fault: `empty`, `not_finite`, `id_out_of_range`, `repeated_node`, `duplicate_cell`
/// (same four nodes in any order), `overused`, `same_sense`, `touching_sheets`, `unused_node`, and `disconnected` if
/// asked for. A quad with a fault of its own is left out of the checks of edges and nodes, so that one mistake is not
/// reported twice. Geometry (folded quads) is quality.hpp's matter.
/// O(n), with a sort of the quads; 125 bytes a quad; read-only and thread-safe.
template <quad_mesh M>
[[nodiscard]] QuadReport verify_quads(const M& mesh, const VerifyQuadsOptions& options = {}) {
    QuadReport report(options.cap);
    const std::size_t count = quad_count(mesh);
    if (count == 0) {
        report.add(MeshFault::empty, {});
    }
    detail::check_finite(mesh, report);
    std::vector<char> bad = detail::check_corners(mesh, report);
    detail::check_duplicates(mesh, bad, report);
    DisjointSets quads(count);
    DisjointSets<std::size_t> corners(4 * count);
    detail::check_edges(mesh, bad, report, quads, corners);
    detail::check_nodes(mesh, bad, options, report, corners);
    detail::check_components(bad, options, report, quads);
    return report;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/verify_quads-inl.hpp>
#endif
