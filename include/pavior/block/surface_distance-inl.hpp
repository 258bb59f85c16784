#pragma once

#include <pavior/block/surface_distance.hpp>
#include <pavior/core/error.hpp>
#include <pavior/marking/detail/near_triangles.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

template <std::size_t N>
[[nodiscard]] std::array<Vec3, N> corner_points(std::span<const Vec3> nodes, const std::array<Index, N>& cell) {
    std::array<Vec3, N> points;
    for (std::size_t k = 0; k < N; ++k) {
        if (cell[k] >= nodes.size()) {
            throw InputError(ErrorCode::bad_index, "node " + std::to_string(cell[k]) + " does not exist");
        }
        points[k] = nodes[cell[k]];
    }
    return points;
}

}  // namespace detail

PAVIOR_INLINE double surface_distance(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                      std::span<const Vec3> surface_nodes, std::span<const TriCorners> triangles) {
    if (triangles.empty()) {
        return 0;
    }
    std::vector<std::array<Vec3, 3>> points;
    for (const TriCorners& t : triangles) {
        points.push_back(detail::corner_points(surface_nodes, t));
    }
    const detail::NearTriangles near(std::move(points));
    std::vector<char> seen(nodes.size(), 0);
    double farthest = 0;
    const auto look = [&](const Vec3& x) { farthest = std::max(farthest, near.nearest(x).square); };
    for (const QuadCorners& quad : quads) {
        const auto x = detail::corner_points(nodes, quad);
        for (std::size_t k = 0; k < 4; ++k) {
            if (std::exchange(seen[quad[k]], 1) == 0) {
                look(x[k]);
            }
        }
        look((x[0] + x[1] + x[2] + x[3]) / 4);
    }
    return std::sqrt(farthest);
}

PAVIOR_INLINE double enclosed_volume(std::span<const Vec3> nodes, std::span<const TriCorners> triangles) {
    double volume = 0;
    Vec3 origin = Vec3::Zero();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto x = detail::corner_points(nodes, triangles[t]);
        origin = t == 0 ? x[0] : origin;
        volume += (x[0] - origin).dot((x[1] - origin).cross(x[2] - origin)) / 6;
    }
    return volume;
}

}  // namespace pavior
