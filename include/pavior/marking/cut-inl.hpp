#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/marking/cut.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// All different edges of the tetrahedra for which wanted(low, high), sorted.
template <class Wanted>
[[nodiscard]] std::vector<std::array<Index, 2>> collect_edges(const CutMesh& cut, const Wanted& wanted) {
    std::vector<std::array<Index, 2>> edges;
    for (const TetCorners& tet : cut.mesh.tets) {
        check_stop(cut.execution.stop);
        for (const auto& [i, j] : tet_edges) {
            const auto edge = ascending(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]);
            if (wanted(edge[0], edge[1])) {
                edges.push_back(edge);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Bisects and gives the new nodes their values.
template <class Value>
void bisect_valued(CutMesh& cut, SheetCut& sheet, const std::vector<EdgeCut>& cuts, const Value& value) {
    bisect_edges(cut, cuts);
    for (const EdgeCut& c : cuts) {
        const auto [v, fix] = value(c);
        sheet.values.push_back(v);
        sheet.fixed.push_back(fix);
    }
}

/// True if the middle of an edge contradicts what its ends say about the zero set.
[[nodiscard]] inline bool surprises(const CutMesh& cut, const SheetCut& sheet, Index a, Index b) {
    const double va = sheet.values[a];
    const double vb = sheet.values[b];
    const bool both_fixed = sheet.fixed[a] != 0 && sheet.fixed[b] != 0 && va * vb > 0;
    const Vec3& x = cut.mesh.nodes[a];
    const Vec3 d = cut.mesh.nodes[b] - x;
    const double length = d.norm();
    if (both_fixed || std::abs(va) + std::abs(vb) > length) {
        return false;
    }
    const double least = std::max(1e-3 * length, 4 * sheet.tolerance);
    for (const double t : {0.5, 0.25, 0.75}) {
        const double v = sheet.field(x + t * d);
        if (std::abs(v) > least && v * va <= 0 && v * vb <= 0) {
            return true;
        }
        if (sheet.fixed[a] != 0 && va != 0 && va * vb < 0 && v * va > 0 && std::abs(v) > least) {
            return true;
        }
    }
    return false;
}

/// Bisects edges whose ends do not tell how the curved zero set crosses them.
inline void resolve_curvature(CutMesh& cut, SheetCut& sheet) {
    for (int round = 0; round < 8; ++round) {
        const auto edges = collect_edges(cut, [&](Index a, Index b) { return surprises(cut, sheet, a, b); });
        std::vector<EdgeCut> cuts;
        for (const auto& [a, b] : edges) {
            if (!std::binary_search(sheet.start_edges.begin(), sheet.start_edges.end(), std::array{a, b})) {
                cuts.push_back({a, b, 0.5});
            }
        }
        if (cuts.empty()) {
            return;
        }
        bisect_valued(cut, sheet, cuts, [&](const EdgeCut& c) {
            const double v = sheet.field(0.5 * (cut.mesh.nodes[c.low] + cut.mesh.nodes[c.high]));
            return std::pair(std::abs(v) <= sheet.tolerance ? 0.0 : v, char{0});
        });
    }
}

/// Where the field is zero on an edge whose ends have opposite signs: the false position between samples, away from
/// the ends, and well away from one that was put beside the zero set.
[[nodiscard]] inline double crossing(const CutMesh& cut, const SheetCut& sheet, Index a, Index b) {
    double low = 0;
    double high = 1;
    double at_low = sheet.values[a];
    double at_high = sheet.values[b];
    double t = at_low / (at_low - at_high);
    for (int i = 0; i < 16 && sheet.curved; ++i) {
        const double v = sheet.field(cut.mesh.nodes[a] + t * (cut.mesh.nodes[b] - cut.mesh.nodes[a]));
        if (std::abs(v) <= sheet.tolerance || !(high - low > 1e-3)) {
            break;
        }
        const bool below = (v < 0) == (at_low < 0);
        (below ? low : high) = t;
        (below ? at_low : at_high) = v;
        t = i % 2 == 1 ? 0.5 * (low + high) : low + (high - low) * at_low / (at_low - at_high);
    }
    const double first = sheet.curved && sheet.fixed[a] != 0 ? 0.05 : 1e-9;
    const double last = sheet.curved && sheet.fixed[b] != 0 ? 0.95 : 1 - 1e-9;
    return std::clamp(t, first, last);
}

/// Nodes that were put beside a plane zero set but have an edge across it are on it after all.
inline void release_fixed(const CutMesh& cut, SheetCut& sheet) {
    const auto& v = sheet.values;
    const auto across = collect_edges(cut, [&](Index a, Index b) {
        return ((sheet.fixed[a] != 0) != (sheet.fixed[b] != 0)) && ((v[a] < 0 && v[b] > 0) || (v[a] > 0 && v[b] < 0));
    });
    for (const auto& [a, b] : across) {
        sheet.values[sheet.fixed[a] != 0 ? a : b] = 0;
    }
}

/// Edges of the component of the zero set (of the uncut mesh) that may be kept: sign changes, sorted.
[[nodiscard]] inline std::vector<std::array<Index, 2>> reachable_crossings(const CutMesh& cut, const SheetCut& sheet) {
    const auto& values = sheet.values;
    const auto crosses = [&](Index a, Index b) { return values[a] * values[b] < 0; };
    auto edges = collect_edges(cut, crosses);
    const auto nodes = static_cast<Index>(values.size());
    DisjointSets sets(values.size() + edges.size());
    std::vector<char> started(sets.size(), 0);
    const auto place = [&](Index a, Index b) {
        const auto at = std::lower_bound(edges.begin(), edges.end(), ascending(a, b));
        return nodes + static_cast<Index>(at - edges.begin());
    };
    for (const auto& [a, b] : sheet.start_edges) {
        started[a] = started[b] = 1;
    }
    std::vector<Index> on;
    for (const Index t : IndexRange(cut.mesh.tets.size())) {
        const TetCorners& tet = cut.mesh.tets[t];
        on.clear();
        for (const Index i : tet) {
            if (values[i] == 0) {
                on.push_back(i);
            }
        }
        for (const auto& [i, j] : tet_edges) {
            const Index a = tet[static_cast<std::size_t>(i)];
            const Index b = tet[static_cast<std::size_t>(j)];
            if (crosses(a, b)) {
                on.push_back(place(a, b));
            }
        }
        for (std::size_t k = 1; k < on.size(); ++k) {
            sets.unite(on[0], on[k]);
        }
        if (!on.empty() && sheet.start_marks && cut.marks[t] != 0) {
            started[on[0]] = 1;
        }
    }
    for (const Index i : IndexRange(sets.size())) {
        if (started[i] != 0) {
            started[sets.root(i)] = 1;
        }
    }
    std::size_t kept = 0;
    for (const Index e : IndexRange(edges.size())) {
        if (started[sets.root(nodes + e)] != 0) {
            edges[kept++] = edges[e];
        }
    }
    edges.resize(kept);
    return edges;
}

PAVIOR_INLINE std::vector<SheetFace> bisect_along(CutMesh& cut, SheetCut& sheet) {
    if (sheet.curved) {
        resolve_curvature(cut, sheet);
    } else {
        release_fixed(cut, sheet);
    }
    const auto edges = reachable_crossings(cut, sheet);
    std::vector<EdgeCut> cuts;
    for (const auto& [a, b] : edges) {
        check_stop(cut.execution.stop);
        cuts.push_back({a, b, crossing(cut, sheet, a, b)});
    }
    bisect_valued(cut, sheet, cuts, [](const EdgeCut&) { return std::pair(0.0, char{1}); });
    check_stop(cut.execution.stop);
    return sheet_faces(cut.mesh, sheet);
}

}  // namespace detail

}  // namespace pavior
