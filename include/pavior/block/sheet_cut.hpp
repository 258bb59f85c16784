#pragma once
/// \file
/// Cuts a reference mesh along the zero set of a field and makes layers of those components that start somewhere.

#include <pavior/block/cut_tets.hpp>
#include <pavior/dual/detail/index_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace pavior {

/// Where a node is, seen from a sheet.
enum class Side : std::int8_t {
    negative = -1,
    on = 0,
    positive = 1,
};

/// A field whose zero set becomes a sheet, and the sides of the nodes.
struct SheetCut {
    /// Signed distance to the sheet, roughly a length.
    std::function<double(const Vec3&)> field;
    /// Per node of the mesh: its value; zero exactly on the sheet. bisect_edges() appends.
    std::vector<double> values;
    /// Per node: nonzero if the value was decided by something other than the field (nodes of chains and of patches on
    /// the sheet).
    std::vector<char> fixed;
    /// The zero set is curved: edges are bisected until their ends tell how they cross it.
    bool curved = false;
    /// Absolute values up to this count as zero (a length).
    double tolerance = 0.0;
    /// Edges (ascending pairs, sorted) at which the sheet starts: a face that has one of them is a start.
    std::vector<std::array<Index, 2>> start_edges;
    /// Besides, faces of marked tetrahedra that touch this node are starts; no_index: any node.
    Index start_node = no_index;
    bool start_marks = false;
    /// Edges (ascending pairs, sorted) that the sheet does not cross; those on the boundary need not be listed.
    std::vector<std::array<Index, 2>> barriers;
};

/// A face of the zero set between negative and positive tetrahedra.
struct SheetFace {
    TriCorners nodes{};           ///< ascending
    std::array<Index, 2> tets{};  ///< negative, positive
};

namespace detail {

[[nodiscard]] inline std::array<Index, 2> ascending(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// All different edges of the tetrahedra for which wanted(low, high), sorted.
template <class Wanted>
[[nodiscard]] std::vector<std::array<Index, 2>> collect_edges(const ReferenceMesh& mesh, const Wanted& wanted) {
    std::vector<std::array<Index, 2>> edges;
    for (const TetCorners& tet : mesh.tets) {
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
        const auto edges = collect_edges(cut.mesh, [&](Index a, Index b) { return surprises(cut, sheet, a, b); });
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
    const auto across = collect_edges(cut.mesh, [&](Index a, Index b) {
        return ((sheet.fixed[a] != 0) != (sheet.fixed[b] != 0)) && ((v[a] < 0 && v[b] > 0) || (v[a] > 0 && v[b] < 0));
    });
    for (const auto& [a, b] : across) {
        sheet.values[sheet.fixed[a] != 0 ? a : b] = 0;
    }
}

/// Sign of a tetrahedron none of whose edges changes sign: 0 if all its nodes are on the sheet.
[[nodiscard]] inline int sign_of(const SheetCut& sheet, const TetCorners& tet) {
    for (const Index i : tet) {
        if (sheet.values[i] != 0) {
            return sheet.values[i] < 0 ? -1 : 1;
        }
    }
    return 0;
}

/// A face on the zero set as one tetrahedron sees it.
struct ZeroSide {
    TriCorners nodes{};
    Index tet = 0;
    int sign = 0;
};

[[nodiscard]] inline std::vector<ZeroSide> zero_sides(const ReferenceMesh& mesh, const SheetCut& sheet) {
    std::vector<ZeroSide> sides;
    for (const Index t : IndexRange(mesh.tets.size())) {
        const TetCorners& tet = mesh.tets[t];
        int zeros = 0;
        for (const Index i : tet) {
            zeros += sheet.values[i] == 0 ? 1 : 0;
        }
        for (std::size_t k = 0; zeros >= 3 && k < 4; ++k) {
            TriCorners f{};
            for (std::size_t j = 0; j < 3; ++j) {
                f[j] = tet[static_cast<std::size_t>(tet_faces[k][j])];
            }
            if (sheet.values[f[0]] == 0 && sheet.values[f[1]] == 0 && sheet.values[f[2]] == 0) {
                std::sort(f.begin(), f.end());
                sides.push_back({f, t, sign_of(sheet, tet)});
            }
        }
    }
    std::sort(sides.begin(), sides.end(), [](const ZeroSide& a, const ZeroSide& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.tet < b.tet;
    });
    return sides;
}

/// Tetrahedra with all nodes on the sheet join the side that they share more area with.
inline void decide_flat(const ReferenceMesh& mesh, std::vector<ZeroSide>& sides) {
    std::vector<std::array<Index, 2>> flat;  // tet, place in sides
    for (const Index s : IndexRange(sides.size())) {
        if (sides[s].sign == 0) {
            flat.push_back({sides[s].tet, s});
        }
    }
    std::sort(flat.begin(), flat.end());
    const auto other = [&](std::size_t s) -> int {
        const auto same = [&](std::size_t k) { return k < sides.size() && sides[k].nodes == sides[s].nodes; };
        return s > 0 && same(s - 1) ? sides[s - 1].sign : same(s + 1) ? sides[s + 1].sign : 0;
    };
    const auto area = [&](const TriCorners& f) {
        return (mesh.nodes[f[1]] - mesh.nodes[f[0]]).cross(mesh.nodes[f[2]] - mesh.nodes[f[0]]).norm();
    };
    for (int pass = 0; pass < 4; ++pass) {
        for (std::size_t i = 0; i < flat.size();) {
            double vote = 0;
            std::size_t end = i;
            for (; end < flat.size() && flat[end][0] == flat[i][0]; ++end) {
                vote += other(flat[end][1]) * area(sides[flat[end][1]].nodes);
            }
            const int sign = vote > 0 ? 1 : vote < 0 ? -1 : pass == 3 ? 1 : 0;
            for (; i < end; ++i) {
                sides[flat[i][1]].sign = sides[flat[i][1]].sign == 0 || pass < 3 ? sign : sides[flat[i][1]].sign;
            }
        }
    }
}

}  // namespace detail

/// The faces between the negative and the positive tetrahedra of a mesh in which no edge changes sign. O(n).
[[nodiscard]] inline std::vector<SheetFace> sheet_faces(const ReferenceMesh& mesh, const SheetCut& sheet) {
    std::vector<detail::ZeroSide> sides = detail::zero_sides(mesh, sheet);
    detail::decide_flat(mesh, sides);
    std::vector<SheetFace> faces;
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const detail::ZeroSide& a = sides[i];
        const detail::ZeroSide& b = sides[i + 1];
        if (a.nodes == b.nodes && a.sign * b.sign < 0) {
            faces.push_back({a.nodes, a.sign < 0 ? std::array{a.tet, b.tet} : std::array{b.tet, a.tet}});
        }
    }
    return faces;
}

namespace detail {

/// Nodes on the boundary, and its edges among nodes of the sheet, sorted.
struct BoundaryOf {
    std::vector<std::array<Index, 2>> edges;
    [[nodiscard]] bool has(std::array<Index, 2> edge) const {
        return std::binary_search(edges.begin(), edges.end(), edge);
    }
};
[[nodiscard]] inline BoundaryOf boundary_on_sheet(const ReferenceMesh& mesh, const SheetCut& sheet) {
    BoundaryOf boundary;
    for (const TaggedTriangle& f : mesh.patches) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto edge = ascending(f.nodes[k], f.nodes[(k + 1) % 3]);
            if (sheet.values[edge[0]] == 0 && sheet.values[edge[1]] == 0) {
                boundary.edges.push_back(edge);
            }
        }
    }
    std::sort(boundary.edges.begin(), boundary.edges.end());
    return boundary;
}

[[nodiscard]] inline bool is_start(const CutMesh& cut, const SheetCut& sheet, const SheetFace& face) {
    const auto& f = face.nodes;
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::binary_search(sheet.start_edges.begin(), sheet.start_edges.end(), ascending(f[k], f[(k + 1) % 3]))) {
            return true;
        }
    }
    if (!sheet.start_marks || (cut.marks[face.tets[0]] == 0 && cut.marks[face.tets[1]] == 0)) {
        return false;
    }
    return sheet.start_node == no_index || f[0] == sheet.start_node || f[1] == sheet.start_node ||
           f[2] == sheet.start_node;
}

/// The faces that hang together with a start across edges inside the solid that are no barriers.
[[nodiscard]] inline std::vector<SheetFace> keep_started(const CutMesh& cut, const SheetCut& sheet,
                                                         const std::vector<SheetFace>& faces) {
    const BoundaryOf boundary = boundary_on_sheet(cut.mesh, sheet);
    struct Use {
        std::array<Index, 2> edge;
        Index face;
    };
    std::vector<Use> uses;
    for (const Index f : IndexRange(faces.size())) {
        for (std::size_t k = 0; k < 3; ++k) {
            uses.push_back({ascending(faces[f].nodes[k], faces[f].nodes[(k + 1) % 3]), f});
        }
    }
    std::sort(uses.begin(), uses.end(),
              [](const Use& a, const Use& b) { return a.edge != b.edge ? a.edge < b.edge : a.face < b.face; });
    IndexSets sets(faces.size());
    for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
        if (uses[i].edge == uses[i + 1].edge && !boundary.has(uses[i].edge) &&
            !std::binary_search(sheet.barriers.begin(), sheet.barriers.end(), uses[i].edge)) {
            sets.unite(uses[i].face, uses[i + 1].face);
        }
    }
    std::vector<char> started(faces.size(), 0);
    for (const Index f : IndexRange(faces.size())) {
        if (is_start(cut, sheet, faces[f])) {
            started[sets.root(f)] = 1;
        }
    }
    std::vector<SheetFace> kept;
    for (const Index f : IndexRange(faces.size())) {
        if (started[sets.root(f)] != 0) {
            kept.push_back(faces[f]);
        }
    }
    return kept;
}

/// Edges of the component of the zero set (of the uncut mesh) that may be kept: sign changes, sorted.
[[nodiscard]] inline std::vector<std::array<Index, 2>> reachable_crossings(const CutMesh& cut, const SheetCut& sheet) {
    const auto& values = sheet.values;
    const auto crosses = [&](Index a, Index b) { return values[a] * values[b] < 0; };
    auto edges = collect_edges(cut.mesh, crosses);
    const auto nodes = static_cast<Index>(values.size());
    IndexSets sets(values.size() + edges.size());
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

/// Appends the faces that are not layers yet. \return how many
inline std::size_t add_layers(CutMesh& cut, const std::vector<SheetFace>& faces, Index id) {
    std::vector<TriCorners> known;
    for (TriCorners f : cut.mesh.layers) {
        std::sort(f.begin(), f.end());
        known.push_back(f);
    }
    std::sort(known.begin(), known.end());
    std::size_t added = 0;
    for (const SheetFace& face : faces) {
        if (!std::binary_search(known.begin(), known.end(), face.nodes)) {
            cut.mesh.layers.push_back(face.nodes);
            cut.layer_sheets.push_back(id);
            ++added;
        }
    }
    return added;
}

}  // namespace detail

/// Cuts \p cut along the zero set of \p sheet and makes layers, with the sheet id \p id, of its components that start
/// at the start edges or marks; elsewhere nothing is cut. values and fixed must cover the nodes of the mesh; start
/// edges must be edges of the mesh with both values zero. \return number of new layers. O(n) a call, and a few rounds
/// of bisections where the zero set is curved.
inline std::size_t cut_sheet(CutMesh& cut, SheetCut& sheet, Index id) {
    if (sheet.curved) {
        detail::resolve_curvature(cut, sheet);
    }
    if (!sheet.curved) {
        detail::release_fixed(cut, sheet);
    }
    const auto edges = detail::reachable_crossings(cut, sheet);
    std::vector<EdgeCut> cuts;
    for (const auto& [a, b] : edges) {
        cuts.push_back({a, b, detail::crossing(cut, sheet, a, b)});
    }
    detail::bisect_valued(cut, sheet, cuts, [](const EdgeCut&) { return std::pair(0.0, char{1}); });
    const std::vector<SheetFace> faces = sheet_faces(cut.mesh, sheet);
    return detail::add_layers(cut, detail::keep_started(cut, sheet, faces), id);
}

}  // namespace pavior
