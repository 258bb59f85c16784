#pragma once

#include <pavior/marking/cut.hpp>
#include <pavior/marking/detail/faceted_field.hpp>
#include <pavior/marking/detail/near_triangles.hpp>
#include <pavior/marking/field.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Surfaces and what of the boundary they continue.
struct BlendField {
    struct Part {
        PatchSurface surface;
        double sign = 1.0;
        NearTriangles triangles;
    };
    std::vector<Part> parts;

    [[nodiscard]] double operator()(const Vec3& x) const {
        double sum = 0;
        double total = 0;
        for (const Part& part : parts) {
            const double square = part.triangles.nearest(x).square;
            const double value = part.sign * part.surface.distance(x);
            if (!(square > 1e-200)) {
                return value;
            }
            sum += value / square;
            total += 1 / square;
        }
        return sum / total;
    }
};

/// Which side of the surface the material behind a boundary face on it is: 0 if the face is not on the surface.
[[nodiscard]] inline int material_side(const PatchSurface& s, double sign, double band, const ReferenceMesh& mesh,
                                       const TaggedTriangle& face) {
    std::array<Vec3, 3> x{mesh.nodes[face.nodes[0]], mesh.nodes[face.nodes[1]], mesh.nodes[face.nodes[2]]};
    for (const Vec3& p : x) {
        if (!(std::abs(s.distance(p)) <= band)) {
            return 0;
        }
    }
    const Facet facet = make_facet(x[0], x[1], x[2]);
    const double along = s.normal(facet.centre).dot(facet.normal);
    return along * sign > 0.9 ? -1 : along * sign < -0.9 ? 1 : 0;
}

/// Decides the sides of the nodes of boundary faces on the surfaces of the group, and zero on its chains.
inline void decide_sides(const ReferenceMesh& mesh, const SheetGroup& group, std::span<const Front> fronts,
                         SheetCut& sheet) {
    std::vector<signed char> sides(mesh.nodes.size(), 0);
    std::vector<std::int32_t> curves;
    for (const SheetMember& member : group.members) {
        const double band = sheet.tolerance + 1.5 * member.surface.sagitta;
        std::vector<std::int32_t> patches;
        for (const Index f : member.fronts) {
            patches.push_back(fronts[f].patch);
            curves.push_back(fronts[f].curve);
        }
        if (group.kind == SheetKind::reversal) {
            continue;
        }
        for (const TaggedTriangle& face : mesh.patches) {
            if (group.members.size() > 1 && std::find(patches.begin(), patches.end(), face.tag) == patches.end()) {
                continue;
            }
            const int side = material_side(member.surface, member.sign, band, mesh, face);
            for (std::size_t k = 0; side != 0 && k < 3; ++k) {
                signed char& at = sides[face.nodes[k]];
                at = at == 0 || at == side ? static_cast<signed char>(side) : static_cast<signed char>(2);
            }
        }
    }
    for (const Index i : IndexRange(mesh.nodes.size())) {
        if (sides[i] != 0) {
            sheet.fixed[i] = 1;
            sheet.values[i] = sides[i] == 2 ? 0.0 : sides[i] * 0.5 * sheet.tolerance;
        }
    }
    for (const FeatureEdge& edge : mesh.curves) {
        if (std::find(curves.begin(), curves.end(), edge.curve) != curves.end()) {
            sheet.start_edges.push_back(ascending(edge.nodes[0], edge.nodes[1]));
            for (const Index i : edge.nodes) {
                sheet.fixed[i] = 1;
                sheet.values[i] = 0;
            }
        }
    }
    std::sort(sheet.start_edges.begin(), sheet.start_edges.end());
}

}  // namespace detail

PAVIOR_INLINE SheetCut sheet_field(const ReferenceMesh& mesh, const SheetGroup& group, std::span<const Front> fronts,
                                   const FrontBoundary& boundary, double tolerance) {
    SheetCut sheet;
    sheet.tolerance = tolerance;
    detail::BlendField blend;
    for (const SheetMember& member : group.members) {
        sheet.curved = sheet.curved || member.surface.kind != SurfaceKind::plane || group.members.size() > 1;
        std::vector<std::array<Vec3, 3>> triangles;
        for (const Index f : member.fronts) {
            for (const Index t : fronts[f].region) {
                const TriCorners& c = boundary.surface.triangles[t];
                triangles.push_back({mesh.nodes[c[0]], mesh.nodes[c[1]], mesh.nodes[c[2]]});
            }
        }
        blend.parts.push_back({member.surface, member.sign, detail::NearTriangles(std::move(triangles))});
    }
    if (blend.parts.size() == 1) {
        detail::BlendField::Part& part = blend.parts[0];
        if (part.surface.kind == SurfaceKind::plane) {
            sheet.field = [surface = std::move(part.surface)](const Vec3& x) { return surface.distance(x); };
        } else {
            sheet.field = detail::FacetedField{std::move(part.surface), std::move(part.triangles)};
        }
    } else {
        sheet.field = std::move(blend);
    }
    sheet.values.resize(mesh.nodes.size());
    sheet.fixed.assign(mesh.nodes.size(), 0);
    for (const Index i : IndexRange(mesh.nodes.size())) {
        const double v = sheet.field(mesh.nodes[i]);
        sheet.values[i] = std::abs(v) <= tolerance ? 0.0 : v;
    }
    detail::decide_sides(mesh, group, fronts, sheet);
    return sheet;
}

}  // namespace pavior
