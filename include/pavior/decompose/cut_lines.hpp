#pragma once
/// \file
/// Lines, circles and cut surfaces: distances, and which are the same.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/decompose/solid_cut.hpp>
#include <pavior/many_to_many/revolution.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// An arc of a circle, or all of it.
struct CircleArc {
    Axis axis;  ///< through the centre, which is its origin
    double radius = 0;
};

[[nodiscard]] inline double distance_to_line(const Vec3& x, const Axis& line) {
    return (x - line.origin).cross(line.direction).norm();
}

/// The middle between two lines that come closer than \p tolerance; nothing for parallel ones and others.
[[nodiscard]] PAVIOR_INLINE std::optional<Vec3> common_point(const Axis& a, const Axis& b, double tolerance);

/// Positive on one side of a surface, negative on the other. Of a half-plane: as the whole plane, but 0 beyond its
/// line.
[[nodiscard]] PAVIOR_INLINE double signed_distance(const CutSurface& surface, const Vec3& x);

/// Of one kind and in one place.
[[nodiscard]] PAVIOR_INLINE bool same_surface(const CutSurface& a, const CutSurface& b, double tolerance);

/// The centre of the circle through three points; nothing where they lie on a line, or nearly (to 1e-9).
[[nodiscard]] PAVIOR_INLINE std::optional<Vec3> circle_centre(const Vec3& a, const Vec3& b, const Vec3& c);

/// How far \p x is from a curve.
[[nodiscard]] PAVIOR_INLINE double distance_to_curve(const Vec3& x, const CutCurve& curve);

/// The edges that lie on curves of \p cuts, to 1e-5 of their length, ascending. Five evaluations an edge.
template <brep B>
[[nodiscard]] std::vector<EdgeId> edges_on_curves(const B& b, std::span<const SolidCut> cuts) {
    std::vector<EdgeId> result;
    if (std::all_of(cuts.begin(), cuts.end(), [](const SolidCut& cut) { return cut.curves.empty(); })) {
        return result;
    }
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.edge_count()); ++i) {
        const EdgeId e{i};
        const auto range = b.edge_range(e);
        std::vector<Vec3> points;
        for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            points.push_back(b.edge_point(e, range[0] + part * (range[1] - range[0])));
        }
        const double near = 1e-5 * b.edge_length(e);
        const auto carries = [&](const CutCurve& curve) {
            return std::all_of(points.begin(), points.end(),
                               [&](const Vec3& x) { return distance_to_curve(x, curve) <= near; });
        };
        if (near > 0 && std::any_of(cuts.begin(), cuts.end(), [&](const SolidCut& cut) {
                return std::any_of(cut.curves.begin(), cut.curves.end(), carries);
            })) {
            result.push_back(e);
        }
    }
    return result;
}

/// Whether five points of an edge lie on a line, to 1e-6 of its length.
template <brep B>
[[nodiscard]] bool is_straight(const B& b, EdgeId edge) {
    const auto range = b.edge_range(edge);
    const Vec3 first = b.edge_point(edge, range[0]);
    const Vec3 last = b.edge_point(edge, range[1]);
    const double length = (last - first).norm();
    if (!(length > 0.5 * b.edge_length(edge))) {
        return false;
    }
    const Axis line{first, (last - first) / length};
    for (const double part : {0.23, 0.5, 0.71}) {
        if (distance_to_line(b.edge_point(edge, range[0] + part * (range[1] - range[0])), line) > 1e-6 * length) {
            return false;
        }
    }
    return true;
}

/// The circle that an edge runs on, to 1e-6 of its radius; nothing for other edges.
template <brep B>
[[nodiscard]] std::optional<CircleArc> circle_of(const B& b, EdgeId edge) {
    const auto range = b.edge_range(edge);
    const auto at = [&](double part) { return b.edge_point(edge, range[0] + part * (range[1] - range[0])); };
    const Vec3 p = at(0);
    const std::optional<Vec3> centre = circle_centre(p, at(0.31), at(0.67));
    if (!centre) {
        return std::nullopt;
    }
    const Vec3 normal = (at(0.31) - p).cross(at(0.67) - p).normalized();
    const CircleArc arc{{*centre, normal}, (*centre - p).norm()};
    for (const double part : {0.12, 0.5, 0.83, 1.0}) {
        const Vec3 x = at(part) - arc.axis.origin;
        if (std::abs(x.norm() - arc.radius) > 1e-6 * arc.radius ||
            std::abs(x.dot(arc.axis.direction)) > 1e-6 * arc.radius) {
            return std::nullopt;
        }
    }
    return arc;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/decompose/cut_lines-inl.hpp>
#endif
