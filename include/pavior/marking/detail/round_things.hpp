#pragma once
/// \file
/// What is round in a cell complex, its axes and centres: closed chains, patches with too few corners.

#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/faces.hpp>
#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/fronts.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Something round: sheets through its axis start at its edges.
struct RoundThing {
    Vec3 point{0, 0, 0};
    Vec3 axis{0, 0, 0};                ///< unit; null: none, sheets go through the point
    Vec3 across{0, 0, 0};              ///< unit or null: preferred normal of a first sheet, perpendicular to the axis
    bool one_sheet = false;            ///< only that one
    bool lengthwise = false;           ///< a cross-section of the tube: only the sheets along the tube
    std::optional<PatchSurface> tube;  ///< torus: the plane and the cylinder through the circle of its centres, too
    double size = 0;
    std::vector<std::array<Index, 2>> edges;
};

[[nodiscard]] inline std::vector<std::array<Index, 2>> path_edges(std::span<const Index> path) {
    std::vector<std::array<Index, 2>> edges;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        edges.push_back(ascending(path[i], path[i + 1]));
    }
    return edges;
}

/// True if a circle was fitted to points round the origin that lie on it, or has its centre close to the origin.
[[nodiscard]] inline bool trusted(const Circle& circle, std::span<const Vec2> points) {
    const auto on = [&](const Vec2& x) {
        return std::abs((x - circle.centre).norm() - circle.radius) <= 0.02 * circle.radius;
    };
    const double off = circle.centre.norm();
    return off < 0.05 * circle.radius ||
           (points.size() >= 6 && off < 0.5 * circle.radius && std::all_of(points.begin(), points.end(), on));
}

/// Axis of a closed chain: the normal of its area vector through the centre of the circle that fits, or its centroid.
[[nodiscard]] inline RoundThing round_chain(std::span<const Vec3> nodes, std::span<const Index> path) {
    RoundThing thing;
    thing.edges = path_edges(path);
    Vec3 centre(0, 0, 0);
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double step = (nodes[path[i + 1]] - nodes[path[i]]).norm();
        centre += 0.5 * step * (nodes[path[i]] + nodes[path[i + 1]]);
        length += step;
    }
    centre /= length;
    Vec3 area(0, 0, 0);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        area += (nodes[path[i]] - centre).cross(nodes[path[i + 1]] - centre);
    }
    thing.axis = area.stableNormalized();
    const Vec3 u = thing.axis.unitOrthogonal();
    const Vec3 v = thing.axis.cross(u);
    std::vector<Vec2> flat;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const Vec3& x = nodes[path[i]];
        const Vec3 before = (x - nodes[path[i > 0 ? i - 1 : path.size() - 2]]).stableNormalized();
        const Vec3 after = (nodes[path[i + 1]] - x).stableNormalized();
        if (before.cross(after).norm() > 1e-4) {  // others lie on the chords
            flat.emplace_back(u.dot(x - centre), v.dot(x - centre));
        }
    }
    if (const std::optional<Circle> circle = fit_circle(flat); circle && trusted(*circle, flat)) {
        centre += circle->centre[0] * u + circle->centre[1] * v;
    }
    thing.point = centre;
    thing.size = length;
    return thing;
}

/// The triangles of a patch as facets, all on one side, with its edges and those of its corners that are known to be on
/// the surface behind it (`on_surface`, per node), all if they are few.
struct PatchShape {
    std::vector<Facet> facets;
    std::vector<Vec3> points;
    std::vector<std::array<Index, 2>> edges;
};
[[nodiscard]] inline PatchShape patch_shape(const ReferenceMesh& mesh, const CellSnapshot& s, Index patch,
                                            std::span<const char> on_surface) {
    PatchShape shape;
    std::vector<Index> nodes;
    for (const Index f : IndexRange(s.topology.faces.size())) {
        if (s.complex.face_patch[f] != patch) {
            continue;
        }
        const Index t = s.topology.face_tets[f][0];
        TriCorners c = tet_face(mesh.tets[t], local_face(s.topology, t, f));
        shape.facets.push_back(make_facet(mesh.nodes[c[0]], mesh.nodes[c[1]], mesh.nodes[c[2]]));
        for (std::size_t k = 0; k < 3; ++k) {
            nodes.push_back(c[k]);
            shape.edges.push_back(ascending(c[k], c[(k + 1) % 3]));
        }
    }
    std::sort(shape.edges.begin(), shape.edges.end());
    shape.edges.erase(std::unique(shape.edges.begin(), shape.edges.end()), shape.edges.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto known = std::count_if(nodes.begin(), nodes.end(), [&](Index i) { return on_surface[i] != 0; });
    for (const Index i : nodes) {
        if (known < 6 || on_surface[i] != 0) {
            shape.points.push_back(mesh.nodes[i]);
        }
    }
    return shape;
}

/// The surface that fits a patch well enough to find its centre or axis: nodes between those of the original surface
/// are beside the true one.
[[nodiscard]] inline PatchSurface rough_fit(const PatchShape& shape) {
    double size = 0;
    for (const Vec3& x : shape.points) {
        size = std::max(size, (x - shape.points.front()).norm());
    }
    return fit_surface(shape.facets, shape.points, 0.02 * size);
}

/// Axis of a patch without vertices or with two: that of the surface that fits it, or its mean normal.
[[nodiscard]] inline RoundThing round_patch(const ReferenceMesh& mesh, const CellSnapshot& s, Index patch,
                                            std::span<const char> on_surface) {
    PatchShape shape = patch_shape(mesh, s, patch, on_surface);
    RoundThing thing;
    thing.point = mean_centre(shape.facets);
    double area = 0;
    for (const Facet& f : shape.facets) {
        area += f.area;
    }
    thing.size = std::sqrt(area);
    const Vec3 normal = mean_normal(shape.facets);
    if (normal.norm() > 0.2 * area) {
        thing.axis = normal.normalized();
    } else {
        const PatchSurface fit = rough_fit(shape);
        if (fit.kind == SurfaceKind::sphere) {
            thing.point = fit.point;
        } else if (fit.kind == SurfaceKind::torus && s.complex.patch_loops[patch] == s.complex.patch_loops[patch + 1]) {
            thing.point = fit.point;
            thing.axis = fit.axis;
            thing.tube = fit;
        } else if (const auto axis = axis_of_revolution(shape.facets)) {
            thing.point += axis->second * axis->second.dot(thing.point - axis->first) - (thing.point - axis->first);
            thing.axis = axis->second;
        }
    }
    thing.edges = std::move(shape.edges);
    return thing;
}

/// The torus of which a closed chain is a cross-section: that of a boundary patch beside it.
[[nodiscard]] inline std::optional<PatchSurface> tube_through(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                              Index chain, const RoundThing& thing,
                                                              std::span<const char> on_surface) {
    for (const Index p : IndexRange(s.complex.patches.size())) {
        bool beside = false;
        for (Index l = s.complex.patch_loops[p]; l < s.complex.patch_loops[p + 1]; ++l) {
            const auto sides = s.complex.loop(l);
            beside = beside || std::any_of(sides.begin(), sides.end(), [&](const auto& x) { return x.chain == chain; });
        }
        if (!beside || !s.topology.boundary(s.complex.patches[p])) {
            continue;
        }
        const PatchSurface fit = rough_fit(patch_shape(mesh, s, p, on_surface));
        if (fit.kind != SurfaceKind::torus) {
            continue;
        }
        const AxisPoint at = about_axis(fit, thing.point);
        const double off = std::hypot(at.radius - fit.radius, at.height);
        if (off < 0.1 * fit.tube && std::abs(fit.axis.cross(at.out).dot(thing.axis)) > 0.9) {
            return fit;
        }
    }
    return std::nullopt;
}

/// Two corners: a plane halfway between them.
inline void halve_between_corners(const ReferenceMesh& mesh, const CellSnapshot& s, Index patch, RoundThing& thing) {
    std::vector<Vec3> corners;
    for (Index l = s.complex.patch_loops[patch]; l < s.complex.patch_loops[patch + 1]; ++l) {
        for (const PatchSide& side : s.complex.loop(l)) {
            if (side.vertex != no_index) {
                corners.push_back(mesh.nodes[s.complex.vertices[side.vertex]]);
            }
        }
    }
    if (corners.size() == 2 && (corners[0] - corners[1]).norm() > 0) {
        thing.point = 0.5 * (corners[0] + corners[1]);
        thing.across = (corners[1] - corners[0]).normalized();
        thing.one_sheet = true;
    }
}

[[nodiscard]] inline bool coaxial(const RoundThing& a, const RoundThing& b, double tolerance) {
    if (a.axis.isZero() != b.axis.isZero() || a.one_sheet || b.one_sheet || a.lengthwise != b.lengthwise ||
        a.tube.has_value() != b.tube.has_value()) {
        return false;
    }
    const auto one_line = [&](const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
        return std::abs(u.dot(v)) > 0.999 && (q - p - u.dot(q - p) * u).norm() <= tolerance;
    };
    if (a.tube) {
        return one_line(a.tube->point, a.tube->axis, b.tube->point, b.tube->axis) &&
               std::abs(a.tube->radius - b.tube->radius) <= tolerance &&
               std::abs(a.tube->axis.dot(b.tube->point - a.tube->point)) <= tolerance;
    }
    return a.axis.isZero() ? (b.point - a.point).norm() <= tolerance : one_line(a.point, a.axis, b.point, b.axis);
}

/// Everything round that is in the way: closed chains first, patches if there is no such chain, cells if neither.
[[nodiscard]] inline std::vector<RoundThing> round_things(const ReferenceMesh& mesh, const CellSnapshot& s) {
    std::vector<RoundThing> things;
    if (s.report.valid()) {
        return things;
    }
    const std::vector<char> on_surface = front_boundary(mesh, s.topology).on_surface;
    for (const DualViolation& v : s.report.violations) {
        if (v.fault == DualFault::chain_closed || v.fault == DualFault::chain_one_vertex) {
            things.push_back(round_chain(mesh.nodes, s.complex.chain_path(v.ids[0])));
            things.back().tube = tube_through(mesh, s, v.ids[0], things.back(), on_surface);
            things.back().lengthwise = things.back().tube.has_value();
        }
    }
    if (!things.empty()) {
        return things;
    }
    for (const DualViolation& v : s.report.violations) {
        if (v.fault == DualFault::patch_not_disc || v.fault == DualFault::patch_few_corners) {
            things.push_back(round_patch(mesh, s, v.ids[0], on_surface));
            if (v.fault == DualFault::patch_few_corners && v.ids[1] == 2) {
                halve_between_corners(mesh, s, v.ids[0], things.back());
            }
        }
    }
    return things;
}

inline void merge_coaxial(std::vector<RoundThing>& things, double tolerance) {
    std::vector<RoundThing> merged;
    for (RoundThing& thing : things) {
        const auto same = std::find_if(merged.begin(), merged.end(),
                                       [&](const RoundThing& m) { return coaxial(m, thing, tolerance); });
        if (same == merged.end()) {
            merged.push_back(std::move(thing));
        } else {
            same->edges.insert(same->edges.end(), thing.edges.begin(), thing.edges.end());
        }
    }
    things.swap(merged);
}

}  // namespace detail

}  // namespace pavior
