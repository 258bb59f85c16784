#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/marking/faces.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

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

PAVIOR_INLINE std::vector<SheetFace> sheet_faces(const ReferenceMesh& mesh, const SheetCut& sheet) {
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

PAVIOR_INLINE std::vector<SheetFace> keep_started(const CutMesh& cut, const SheetCut& sheet,
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
    DisjointSets sets(faces.size());
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

PAVIOR_INLINE std::size_t add_layers(CutMesh& cut, const std::vector<SheetFace>& faces, Index id) {
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

}  // namespace pavior
