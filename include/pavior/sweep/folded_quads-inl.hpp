#pragma once

#include <pavior/sweep/folded_quads.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE double signed_area(std::span<const Vec2> polygon) {
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - polygon[0];
        const Vec2 b = polygon[i + 1] - polygon[0];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

PAVIOR_INLINE std::vector<Index> folded_plane_quads(std::span<const Vec2> uv, std::span<const QuadCorners> quads,
                                                    bool reversed) {
    std::vector<Index> ids;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const QuadPoints2 x = detail::gather(uv, quads[q]);
        std::array<double, 4> areas = quad_corner_areas(x);
        for (double& area : areas) {
            area = reversed ? -area : area;
        }
        if (detail::folded(x, areas)) {
            ids.push_back(static_cast<Index>(q));
        }
    }
    return ids;
}

namespace detail {

/// du x dv of length 1; null where the parametrisation is singular.
[[nodiscard]] inline Vec3 unit_surface_normal(const AnySurface& surface, const Vec2& uv) {
    const std::pair<Vec3, Vec3> d = surface.derivatives(uv);
    const Vec3 du = d.first;
    const Vec3 dv = d.second;
    const Vec3 normal = du.cross(dv);
    const double length = normal.norm();
    return length > 1e-12 * du.norm() * dv.norm() ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

/// The normal in the middle of a quad, its corners' where the middle is singular; null if there is none.
[[nodiscard]] inline Vec3 quad_surface_normal(const AnySurface& surface, const std::array<Vec2, 4>& uv) {
    Vec3 normal = unit_surface_normal(surface, 0.25 * (uv[0] + uv[1] + uv[2] + uv[3]));
    if (normal == Vec3::Zero()) {
        for (const Vec2& p : uv) {
            normal += unit_surface_normal(surface, p);
        }
    }
    const double length = normal.norm();
    return length > 0.0 ? Vec3(normal / length) : normal;
}

}  // namespace detail

PAVIOR_INLINE std::vector<Index> folded_surface_quads(const AnySurface& surface, std::span<const Vec3> nodes,
                                                      std::span<const Vec2> uv, std::span<const QuadCorners> quads,
                                                      bool reversed) {
    std::vector<Index> ids;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const QuadPoints2 in_plane = detail::gather(uv, quads[q]);
        Vec3 normal = detail::quad_surface_normal(surface, in_plane);
        normal = reversed ? Vec3(-normal) : normal;
        bool folded = false;
        if (normal == Vec3::Zero()) {
            folded = !folded_plane_quads(uv, quads.subspan(q, 1), reversed).empty();
        } else {
            const QuadPoints x = detail::gather(nodes, quads[q]);
            folded = detail::folded(x, quad_corner_areas(x, normal));
        }
        if (folded) {
            ids.push_back(static_cast<Index>(q));
        }
    }
    return ids;
}

namespace detail {

/// Is the vector area of quad (i, k) nearly opposite to that of each of its two or more neighbours?
[[nodiscard]] inline bool turned_over(const std::vector<Vec3>& areas, std::size_t columns, std::size_t rows,
                                      std::size_t q) {
    int neighbours = 0;
    bool opposite = true;
    const auto look = [&](std::size_t other) {
        ++neighbours;
        opposite = opposite && areas[q].dot(areas[other]) < -0.9 * areas[q].norm() * areas[other].norm();
    };
    const std::size_t i = q % columns;
    const std::size_t k = q / columns;
    if (i > 0) {
        look(q - 1);
    }
    if (i + 1 < columns) {
        look(q + 1);
    }
    if (k > 0) {
        look(q - columns);
    }
    if (k + 1 < rows) {
        look(q + columns);
    }
    return neighbours > 1 && opposite;
}

}  // namespace detail

PAVIOR_INLINE std::vector<Index> folded_grid_quads(const StructuredGrid<Vec3>& grid) {
    const std::vector<QuadCorners> quads = structured_quads(grid.columns, grid.rows);
    const std::span<const Vec3> nodes(grid.nodes);
    std::vector<Vec3> areas(quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        areas[q] = quad_vector_area(detail::gather(nodes, quads[q]));
    }
    std::vector<Index> ids;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const QuadPoints x = detail::gather(nodes, quads[q]);
        if (detail::folded(x, quad_corner_areas(x, quad_normal(x))) ||
            detail::turned_over(areas, grid.columns, grid.rows, q)) {
            ids.push_back(static_cast<Index>(q));
        }
    }
    return ids;
}

}  // namespace pavior
