#pragma once

#include <pavior/marking/detail/round_things.hpp>
#include <pavior/marking/repair_axis.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

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

/// The sheets along a torus: both contain the circle of its centres.
inline void add_tube_sheets(const RoundThing& thing, std::vector<RepairSheet>& sheets) {
    RepairSheet sheet = plane_sheet(SheetKind::axis, thing, thing.tube->axis);
    sheet.surface.point = thing.tube->point;
    sheets.push_back(sheet);
    sheet.surface.kind = SurfaceKind::cylinder;
    sheet.surface.radius = thing.tube->radius;
    sheets.push_back(std::move(sheet));
}

PAVIOR_INLINE void merge_planes(std::vector<RepairSheet>& sheets, double tolerance) {
    const auto same = [&](const RepairSheet& a, const RepairSheet& b) {
        return a.surface.kind == SurfaceKind::plane && b.surface.kind == SurfaceKind::plane &&
               a.surface.axis.cross(b.surface.axis).norm() < 1e-3 &&
               std::abs(a.surface.distance(b.surface.point)) <= tolerance &&
               std::abs(b.surface.distance(a.surface.point)) <= tolerance;
    };
    std::vector<RepairSheet> merged;
    for (RepairSheet& sheet : sheets) {
        const auto first = std::find_if(merged.begin(), merged.end(), [&](const auto& m) { return same(m, sheet); });
        if (first == merged.end()) {
            merged.push_back(std::move(sheet));
        } else {
            first->edges.insert(first->edges.end(), sheet.edges.begin(), sheet.edges.end());
        }
    }
    sheets.swap(merged);
}

}  // namespace detail

PAVIOR_INLINE std::vector<RepairSheet> repair_axes(const ReferenceMesh& mesh, const CellSnapshot& s, double size) {
    std::vector<detail::RoundThing> things = detail::round_things(mesh, s);
    detail::merge_coaxial(things, 5e-3 * size);
    const auto directions = detail::planar_directions(mesh);
    std::vector<RepairSheet> sheets;
    for (const detail::RoundThing& thing : things) {
        if (thing.axis.isZero() && thing.across.isZero()) {
            for (const Vec3& normal : detail::centre_normals(directions)) {
                sheets.push_back(detail::plane_sheet(SheetKind::centre, thing, normal));
            }
            continue;
        }
        if (thing.tube) {
            detail::add_tube_sheets(thing, sheets);
        }
        if (thing.lengthwise) {
            continue;
        }
        const Vec3 normal = detail::first_normal(mesh, thing, directions, things);
        sheets.push_back(detail::plane_sheet(SheetKind::axis, thing, normal));
        if (!thing.one_sheet) {
            sheets.push_back(detail::plane_sheet(SheetKind::axis, thing, thing.axis.cross(normal).normalized()));
        }
    }
    detail::merge_planes(sheets, 1e-3 * size);
    return sheets;
}

}  // namespace pavior
