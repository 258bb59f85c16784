#pragma once

#include <pavior/many_to_many/plane_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<Vec2> divide_polyline(std::span<const Vec2> points, int intervals) {
    std::vector<double> length{0};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        length.push_back(length.back() + (points[i + 1] - points[i]).norm());
    }
    std::vector<Vec2> result{points.front()};
    std::size_t i = 0;
    for (int k = 1; k < intervals; ++k) {
        const double at = length.back() * k / intervals;
        while (i + 2 < points.size() && length[i + 1] < at) {
            ++i;
        }
        const double width = length[i + 1] - length[i];
        const double t = width > 0 ? (at - length[i]) / width : 0;
        result.emplace_back((1 - t) * points[i] + t * points[i + 1]);
    }
    result.push_back(points.back());
    return result;
}

PAVIOR_INLINE std::pair<std::vector<Index>, std::vector<std::size_t>> cell_boundary(const PlaneMesh& mesh,
                                                                                    const PlaneCell& cell) {
    std::pair<std::vector<Index>, std::vector<std::size_t>> result{{}, {0}};
    for (const auto& loop : cell.loops) {
        for (const OrientedPlaneEdge& use : loop) {
            const std::vector<Index>& edge = mesh.edges[use.edge];
            if (use.forward) {
                result.first.insert(result.first.end(), edge.begin(), edge.end() - 1);
            } else {
                result.first.insert(result.first.end(), edge.rbegin(), edge.rend() - 1);
            }
        }
        result.second.push_back(result.first.size());
    }
    return result;
}

PAVIOR_INLINE void part_repeated(const std::vector<Index>& nodes, PlaneRegion& region) {
    std::vector<Index> sorted = nodes;
    std::sort(sorted.begin(), sorted.end());
    const std::vector<Vec2> points = region.points;
    for (std::size_t l = 0; l < region.size(); ++l) {
        const std::size_t first = region.offsets[l];
        const std::size_t n = region.offsets[l + 1] - first;
        for (std::size_t i = 0; i < n; ++i) {
            const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), nodes[first + i]);
            if (high - low > 1) {
                const Vec2& at = points[first + i];
                const Vec2 out = points[first + (i + 1) % n] - at;
                const Vec2 in = points[first + (i + n - 1) % n] - at;
                double angle = std::atan2(out[0] * in[1] - out[1] * in[0], out.dot(in));
                angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
                const Vec2 along = out.normalized();
                const Vec2 bisector(std::cos(angle / 2) * along[0] - std::sin(angle / 2) * along[1],
                                    std::sin(angle / 2) * along[0] + std::cos(angle / 2) * along[1]);
                region.points[first + i] = at + 0.1 * std::min(out.norm(), in.norm()) * bisector;
            }
        }
    }
}

PAVIOR_INLINE bool has_flat_corner(std::span<const Vec2> nodes, std::span<const QuadCorners> quads) {
    constexpr double flat = 1e-5;
    return std::any_of(quads.begin(), quads.end(), [&](const QuadCorners& quad) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 out = nodes[quad[(k + 1) % 4]] - nodes[quad[k]];
            const Vec2 in = nodes[quad[(k + 3) % 4]] - nodes[quad[k]];
            if (!(out[0] * in[1] - out[1] * in[0] > flat * out.norm() * in.norm())) {
                return true;
            }
        }
        return false;
    });
}

}  // namespace detail

}  // namespace pavior
