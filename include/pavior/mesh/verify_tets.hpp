#pragma once
/// \file
/// Checks of tetrahedral meshes: known nodes, positive volumes, conforming.

#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/verify_report.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

/// Options of verify_tets().
struct VerifyTetsOptions {
    std::size_t cap = 16;             ///< offenders of a kind whose ids are kept
    bool allow_unused_nodes = false;  ///< true: nodes of no tetrahedron are no fault
};

/// Result of verify_tets().
struct TetReport : VerifyReport {
    using VerifyReport::VerifyReport;
    std::size_t inner_faces = 0;
    std::size_t boundary_faces = 0;
    double volume = 0.0;      ///< sum of the volumes of the tetrahedra with sound ids
    double min_volume = 0.0;  ///< the smallest of them; NaN if a coordinate is not finite
};

namespace detail {

/// A triangle of a tetrahedron: its nodes ascending, and whether they are an even permutation of its outward order.
struct TetSide {
    TriCorners nodes{};
    Index tet = 0;
    bool even = false;
};

[[nodiscard]] constexpr TetSide tet_side(const TetCorners& c, std::size_t face, Index t) {
    const auto at = [&](std::size_t k) { return c[static_cast<std::size_t>(tet_faces[face][k])]; };
    TetSide side{{at(0), at(1), at(2)}, t, true};
    const auto order = [&](std::size_t i, std::size_t j) {
        if (side.nodes[i] > side.nodes[j]) {
            std::swap(side.nodes[i], side.nodes[j]);
            side.even = !side.even;
        }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return side;
}

template <tet_mesh M>
[[nodiscard]] std::vector<char> check_tet_corners(const M& mesh, TetReport& report) {
    std::vector<char> bad(tet_count(mesh), 0);
    for (const Index t : IndexRange(bad.size())) {
        TetCorners c = tet(mesh, t);
        std::sort(c.begin(), c.end());
        if (c[3] >= node_count(mesh)) {
            report.add(MeshFault::id_out_of_range, {t});
            bad[t] = 1;
        } else if (std::adjacent_find(c.begin(), c.end()) != c.end()) {
            report.add(MeshFault::repeated_node, {t});
            bad[t] = 1;
        }
    }
    return bad;
}

template <tet_mesh M>
void check_tet_nodes(const M& mesh, const VerifyTetsOptions& options, TetReport& report) {
    std::vector<char> used(node_count(mesh), options.allow_unused_nodes ? 1 : 0);
    for (const Index t : IndexRange(tet_count(mesh))) {
        for (const Index i : tet(mesh, t)) {
            if (i < used.size()) {
                used[i] = 1;
            }
        }
    }
    for (const Index i : IndexRange(used.size())) {
        if (!node(mesh, i).allFinite()) {
            report.add(MeshFault::not_finite, {i});
        }
        if (used[i] == 0) {
            report.add(MeshFault::unused_node, {i});
        }
    }
}

template <tet_mesh M>
void check_tet_volumes(const M& mesh, const std::vector<char>& bad, TetReport& report) {
    bool first = true;
    for (const Index t : IndexRange(bad.size())) {
        if (bad[t] != 0) {
            continue;
        }
        const TetCorners c = tet(mesh, t);
        const Vec3 u = node(mesh, c[1]) - node(mesh, c[0]);
        const Vec3 v = node(mesh, c[2]) - node(mesh, c[0]);
        const Vec3 w = node(mesh, c[3]) - node(mesh, c[0]);
        const double volume = (u.x() * (v.y() * w.z() - v.z() * w.y()) - u.y() * (v.x() * w.z() - v.z() * w.x()) +
                               u.z() * (v.x() * w.y() - v.y() * w.x())) /
                              6.0;
        report.volume += volume;
        report.min_volume = first || !(volume >= report.min_volume) ? volume : report.min_volume;
        first = false;
        if (!(volume > 0.0)) {
            report.add(MeshFault::inverted, {t});
        }
    }
}

template <tet_mesh M>
void check_tet_faces(const M& mesh, const std::vector<char>& bad, TetReport& report) {
    std::vector<TetSide> sides;
    sides.reserve(4 * bad.size());
    for (const Index t : IndexRange(bad.size())) {
        for (std::size_t f = 0; f < 4 && bad[t] == 0; ++f) {
            sides.push_back(tet_side(tet(mesh, t), f, t));
        }
    }
    std::sort(sides.begin(), sides.end(), [](const TetSide& a, const TetSide& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.tet < b.tet;
    });
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].nodes == sides[i].nodes) {
            ++end;
        }
        const auto [a, b, c] = sides[i].nodes;
        if (end - i > 2) {
            report.add(MeshFault::overused, {a, b, c});
        } else if (end - i == 2) {
            ++report.inner_faces;
            if (sides[i].even == sides[i + 1].even) {
                report.add(MeshFault::same_sense, {a, b, c});
            }
        } else {
            ++report.boundary_faces;
        }
        i = end;
    }
}
}  // namespace detail

/// Checks \p mesh and lists every fault: `empty`, `not_finite`, `id_out_of_range`, `repeated_node`, `unused_node`,
/// `inverted` (volume not positive), `overused` (triangle of three or more tetrahedra), `same_sense` (its two
/// tetrahedra lie on one side of it). Tetrahedra with bad ids are left out of the checks of volumes and triangles.
/// O(n log n); 80 bytes a tetrahedron; read-only and thread-safe.
template <tet_mesh M>
[[nodiscard]] TetReport verify_tets(const M& mesh, const VerifyTetsOptions& options = {}) {
    TetReport report(options.cap);
    if (tet_count(mesh) == 0) {
        report.add(MeshFault::empty, {});
    }
    detail::check_tet_nodes(mesh, options, report);
    const std::vector<char> bad = detail::check_tet_corners(mesh, report);
    detail::check_tet_volumes(mesh, bad, report);
    detail::check_tet_faces(mesh, bad, report);
    return report;
}

}  // namespace pavior
