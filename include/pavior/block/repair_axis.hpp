#pragma once
/// \file
/// Repair of what is round: planes through the axes of closed chains and of patches with too few corners, or through
/// a centre where there is no axis.

#include <pavior/block/repair_sheet.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Something round: sheets through its axis start at its edges.
struct RoundThing {
    Vec3 point{0, 0, 0};
    Vec3 axis{0, 0, 0};      ///< unit; null: none, sheets go through the point
    Vec3 across{0, 0, 0};    ///< unit or null: preferred normal of a first sheet, perpendicular to the axis
    bool one_sheet = false;  ///< only that one
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
        const Vec3 d = nodes[path[i]] - centre;
        flat.emplace_back(u.dot(d), v.dot(d));
    }
    if (const std::optional<Circle> circle = fit_circle(flat);
        circle && circle->centre.norm() < 0.05 * circle->radius) {
        centre += circle->centre[0] * u + circle->centre[1] * v;
    }
    thing.point = centre;
    thing.size = length;
    return thing;
}

/// The triangles of a patch as facets, all on one side, with its edges.
struct PatchShape {
    std::vector<Facet> facets;
    std::vector<Vec3> points;
    std::vector<std::array<Index, 2>> edges;
};
[[nodiscard]] inline PatchShape patch_shape(const ReferenceMesh& mesh, const CellSnapshot& s, Index patch) {
    PatchShape shape;
    for (const Index f : IndexRange(s.topology.faces.size())) {
        if (s.complex.face_patch[f] != patch) {
            continue;
        }
        const Index t = s.topology.face_tets[f][0];
        TriCorners c = tet_face(mesh.tets[t], local_face(s.topology, t, f));
        shape.facets.push_back(make_facet(mesh.nodes[c[0]], mesh.nodes[c[1]], mesh.nodes[c[2]]));
        for (std::size_t k = 0; k < 3; ++k) {
            shape.points.push_back(mesh.nodes[c[k]]);
            shape.edges.push_back(ascending(c[k], c[(k + 1) % 3]));
        }
    }
    std::sort(shape.edges.begin(), shape.edges.end());
    shape.edges.erase(std::unique(shape.edges.begin(), shape.edges.end()), shape.edges.end());
    return shape;
}

/// Axis of a patch without vertices or with two: that of the surface that fits it, or its mean normal.
[[nodiscard]] inline RoundThing round_patch(const ReferenceMesh& mesh, const CellSnapshot& s, Index patch,
                                            double tolerance) {
    PatchShape shape = patch_shape(mesh, s, patch);
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
        const PatchSurface fit = fit_surface(shape.facets, shape.points, 10 * tolerance);
        if (fit.kind == SurfaceKind::sphere) {
            thing.point = fit.point;
        } else if (const auto axis = axis_of_revolution(shape.facets)) {
            thing.point += axis->second * axis->second.dot(thing.point - axis->first) - (thing.point - axis->first);
            thing.axis = axis->second;
        }
    }
    thing.edges = std::move(shape.edges);
    return thing;
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
    if (a.axis.isZero() != b.axis.isZero() || a.one_sheet || b.one_sheet) {
        return false;
    }
    const Vec3 d = b.point - a.point;
    if (a.axis.isZero()) {
        return d.norm() <= tolerance;
    }
    return std::abs(a.axis.dot(b.axis)) > 0.9999 && (d - a.axis.dot(d) * a.axis).norm() <= tolerance;
}

/// Normals of planar patches with their areas, largest first.
[[nodiscard]] inline std::vector<std::pair<double, Vec3>> planar_directions(const ReferenceMesh& mesh) {
    struct Sum {
        Vec3 normal{0, 0, 0};
        double area = 0;
    };
    std::int32_t last = -1;
    for (const TaggedTriangle& f : mesh.patches) {
        last = std::max(last, f.tag);
    }
    std::vector<Sum> sums(static_cast<std::size_t>(last + 1));
    for (const TaggedTriangle& f : mesh.patches) {
        const Facet facet = make_facet(mesh.nodes[f.nodes[0]], mesh.nodes[f.nodes[1]], mesh.nodes[f.nodes[2]]);
        if (f.tag >= 0) {
            sums[static_cast<std::size_t>(f.tag)].normal += facet.area * facet.normal;
            sums[static_cast<std::size_t>(f.tag)].area += facet.area;
        }
    }
    std::vector<std::pair<double, Vec3>> directions;
    for (const Sum& sum : sums) {
        if (sum.normal.norm() < (1 - 1e-6) * sum.area || !(sum.area > 0)) {
            continue;
        }
        const Vec3 n = sum.normal.normalized();
        const auto known = std::find_if(directions.begin(), directions.end(),
                                        [&](const auto& d) { return std::abs(d.second.dot(n)) > 0.9999; });
        if (known != directions.end()) {
            known->first += sum.area;
        } else {
            directions.emplace_back(sum.area, n);
        }
    }
    std::stable_sort(directions.begin(), directions.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return directions;
}

/// Normal of the first sheet through an axis.
[[nodiscard]] inline Vec3 first_normal(const ReferenceMesh& mesh, const RoundThing& thing,
                                       const std::vector<std::pair<double, Vec3>>& directions,
                                       const std::vector<RoundThing>& things) {
    const auto across = [&](const Vec3& d) { return Vec3(d - thing.axis.dot(d) * thing.axis); };
    if (!thing.across.isZero()) {
        return thing.across;
    }
    for (const auto& [area, direction] : directions) {
        if (std::abs(direction.dot(thing.axis)) < 0.02) {
            return across(direction).normalized();
        }
    }
    for (const RoundThing& other : things) {
        if (const Vec3 d = across(other.point - thing.point); d.norm() > 0.01 * thing.size) {
            return d.normalized();
        }
    }
    const Vec3 to_node = across(mesh.nodes[thing.edges.front()[0]] - thing.point);
    return to_node.norm() > 0 ? Vec3(to_node.cross(thing.axis).normalized()) : Vec3(thing.axis.unitOrthogonal());
}

/// Three directions through a centre: those of planar patches, or the coordinate axes.
[[nodiscard]] inline std::array<Vec3, 3> centre_normals(const std::vector<std::pair<double, Vec3>>& directions) {
    if (directions.empty()) {
        return {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    }
    const Vec3 a = directions.front().second;
    Vec3 b = a.unitOrthogonal();
    for (const auto& [area, direction] : directions) {
        if (const Vec3 d = direction - a.dot(direction) * a; std::abs(direction.dot(a)) < 0.02) {
            b = d.normalized();
            break;
        }
    }
    return {a, b, a.cross(b)};
}

[[nodiscard]] inline RepairSheet plane_sheet(SheetKind kind, const RoundThing& thing, const Vec3& normal) {
    RepairSheet sheet;
    sheet.kind = kind;
    sheet.surface.point = thing.point;
    sheet.surface.axis = normal;
    sheet.edges = thing.edges;
    return sheet;
}

/// Everything round that is in the way: closed chains first, patches if there is no such chain, cells if neither.
[[nodiscard]] inline std::vector<RoundThing> round_things(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                          double tolerance) {
    std::vector<RoundThing> things;
    for (const DualViolation& v : s.report.violations) {
        if (v.fault == DualFault::chain_closed || v.fault == DualFault::chain_one_vertex) {
            things.push_back(round_chain(mesh.nodes, s.complex.chain_path(v.ids[0])));
        }
    }
    if (!things.empty()) {
        return things;
    }
    for (const DualViolation& v : s.report.violations) {
        if (v.fault == DualFault::patch_not_disc || v.fault == DualFault::patch_few_corners) {
            things.push_back(round_patch(mesh, s, v.ids[0], tolerance));
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

/// The sheets through everything round that violates the conditions, all of one axis sharing theirs: two
/// perpendicular planes through each axis, turned to the planar patches of the solid if there are any; three through
/// each centre; one halfway between the corners of a patch with two. Empty if nothing round is in the way.
[[nodiscard]] inline std::vector<RepairSheet> repair_axes(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                          double tolerance, double size) {
    std::vector<detail::RoundThing> things = detail::round_things(mesh, s, tolerance);
    detail::merge_coaxial(things, 1e-3 * size);
    const auto directions = detail::planar_directions(mesh);
    std::vector<RepairSheet> sheets;
    for (const detail::RoundThing& thing : things) {
        if (thing.axis.isZero() && thing.across.isZero()) {
            for (const Vec3& normal : detail::centre_normals(directions)) {
                sheets.push_back(detail::plane_sheet(SheetKind::centre, thing, normal));
            }
            continue;
        }
        const Vec3 normal = detail::first_normal(mesh, thing, directions, things);
        sheets.push_back(detail::plane_sheet(SheetKind::axis, thing, normal));
        if (!thing.one_sheet) {
            sheets.push_back(detail::plane_sheet(SheetKind::axis, thing, thing.axis.cross(normal).normalized()));
        }
    }
    return sheets;
}

}  // namespace pavior
