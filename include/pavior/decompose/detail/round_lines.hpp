#pragma once
/// \file
/// Lines along round faces at which a structured mesh may turn; tested with cut_candidates().

#include <pavior/decompose/cut_lines.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Points of an edge at equal steps of its parameter, from end to end.
template <brep B>
[[nodiscard]] std::vector<Vec3> edge_points(const B& b, EdgeId edge, int pieces = 8) {
    const auto range = b.edge_range(edge);
    std::vector<Vec3> points;
    for (int i = 0; i <= pieces; ++i) {
        points.push_back(b.edge_point(edge, range[0] + (range[1] - range[0]) * i / pieces));
    }
    return points;
}

/// Calls visit(x) with points of each edge of a face.
template <brep B, class Visit>
void for_each_edge_point(const B& b, FaceId face, Visit&& visit) {
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            for (const Vec3& x : edge_points(b, use.edge)) {
                visit(x);
            }
        }
    }
}

/// Degrees round an axis, from \p zero on, in (-180, 180].
[[nodiscard]] inline double azimuth_of(const Vec3& x, const Axis& axis, const Vec3& zero) {
    const Vec3 arm = x - axis.origin;
    return std::atan2(arm.dot(axis.direction.cross(zero)), arm.dot(zero)) * 180 / std::numbers::pi;
}

/// The least range that some azimuths lie in: its begin and its width.
[[nodiscard]] inline std::pair<double, double> azimuth_range(std::vector<double> azimuths) {
    std::sort(azimuths.begin(), azimuths.end());
    double gap = 360 - (azimuths.back() - azimuths.front());
    double begin = azimuths.front();
    for (std::size_t i = 1; i < azimuths.size(); ++i) {
        if (azimuths[i] - azimuths[i - 1] > gap) {
            gap = azimuths[i] - azimuths[i - 1];
            begin = azimuths[i];
        }
    }
    return {begin, 360 - gap};
}

/// By how many degrees a face goes round an axis.
template <brep B>
[[nodiscard]] double degrees_round(const B& b, FaceId face, const Axis& axis) {
    std::vector<double> azimuths;
    const Vec3 zero = axis.direction.unitOrthogonal();
    for_each_edge_point(b, face, [&](const Vec3& x) { azimuths.push_back(azimuth_of(x, axis, zero)); });
    return azimuth_range(azimuths).second;
}

/// Where a structured mesh turns round an axis, degrees: at 45 to the directions that are right-angled to it, or as
/// near to that as leaves the edges of holes in these faces in one quarter.
template <brep B>
[[nodiscard]] std::vector<double> square_corners(const B& b, std::span<const FaceId> faces, const Axis& axis,
                                                 const Vec3& zero) {
    std::vector<std::pair<double, double>> taken;
    for (const FaceId f : faces) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                std::vector<double> azimuths;
                for (const Vec3& x : edge_points(b, use.edge, 16)) {
                    azimuths.push_back(azimuth_of(x, axis, zero));
                }
                const auto range = azimuth_range(azimuths);
                if (range.second > 0.1 && range.second < 170) {
                    taken.push_back(range);
                }
            }
        }
    }
    const auto free = [&](double at) {
        return std::none_of(taken.begin(), taken.end(), [&](const auto& range) {
            constexpr double margin = 4;
            const double into = at - range.first + margin;
            return into - 360 * std::floor(into / 360) < range.second + 2 * margin;
        });
    };
    std::vector<double> result;
    for (const double middle : {45.0, 135.0, 225.0, 315.0}) {
        double at = middle;
        for (double off = 1; off <= 30 && !free(at); off = off > 0 ? -off : 1 - off) {
            at = middle + off;
        }
        result.push_back(free(at) ? at : middle);
    }
    return result;
}

/// The line on a face of revolution on the side \p out of its axis, from end to end; nothing if it is no longer than
/// \p least, or more than half a circle.
template <brep B>
[[nodiscard]] std::optional<CutCurve> meridian(const B& b, FaceId face, const Axis& axis, const Vec3& out,
                                               double least) {
    std::vector<Vec2> profile;  // along the axis, and away from it
    for_each_edge_point(b, face, [&](const Vec3& x) {
        profile.emplace_back((x - axis.origin).dot(axis.direction), distance_to_line(x, axis));
    });
    const auto extent = [&](Eigen::Index k) {
        const auto [low, high] = std::minmax_element(profile.begin(), profile.end(),
                                                     [k](const Vec2& a, const Vec2& c) { return a[k] < c[k]; });
        return std::pair(*low, *high);
    };
    auto ends = extent(0);
    if (const auto radial = extent(1); radial.second[1] - radial.first[1] > ends.second[0] - ends.first[0]) {
        ends = radial;
    }
    const auto at = [&](const Vec2& p) -> Vec3 { return axis.origin + p[0] * axis.direction + p[1] * out; };
    const Vec3 from = at(ends.first);
    const Vec3 to = at(ends.second);
    const Vec3 middle = b.face_point(face, b.closest_on_face(face, 0.5 * (from + to)));
    if (!((to - from).norm() > least) || !((middle - from).dot(to - middle) > 0)) {
        return std::nullopt;
    }
    return CutCurve{from, middle, to};
}

}  // namespace pavior::detail
