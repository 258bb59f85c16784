#pragma once
/// \file
/// Caps with a seam or a pole, seen along one direction: a plane takes the place of the parameters of their surface.

#include <pavior/brep/seamless.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// A plane in space with coordinates in it.
struct CapPlane {
    Vec3 origin = Vec3::Zero();
    Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();  ///< orthonormal

    [[nodiscard]] Vec3 normal() const { return x.cross(y); }
    [[nodiscard]] Vec2 coordinates(const Vec3& p) const { return {x.dot(p - origin), y.dot(p - origin)}; }
    [[nodiscard]] Vec3 point(const Vec2& p) const { return origin + p[0] * x + p[1] * y; }
};

/// The plane through the mean of the points \p loops, perpendicular to the sum of their vector areas; nothing if that
/// is zero: the two rims of a tube.
[[nodiscard]] PAVIOR_INLINE std::optional<CapPlane> plane_of_loops(std::span<const std::vector<Vec3>> loops);

/// The plane of the loops of \p face (without seams), along whose normal every normal of the face at its edges, seams
/// included, leans by less than \p max_lean degrees; nothing if there is none. Its normal is on the side of the face's
/// own. Sixteen evaluations an edge.
template <brep B>
[[nodiscard]] std::optional<CapPlane> cap_plane(const B& b, FaceId face, double max_lean = 80) {
    constexpr int pieces = 16;
    std::vector<std::vector<Vec3>> points;
    for (const EdgeLoop& loop : seamless_loops(b.face_loops(face))) {
        points.emplace_back();
        for (const OrientedEdge& use : loop) {
            const auto [first, last] = b.edge_range(use.edge);
            for (int i = 0; i < pieces; ++i) {
                const double at = static_cast<double>(use.forward ? i : pieces - i) / pieces;
                points.back().push_back(b.edge_point(use.edge, first + at * (last - first)));
            }
        }
    }
    const std::optional<CapPlane> plane = plane_of_loops(points);
    if (!plane) {
        return std::nullopt;
    }
    const double least = std::cos(max_lean / detail::degrees_per_radian);
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            for (int i = 0; i < pieces; ++i) {
                const Vec3 normal = outside_normal(b, {face, true}, use, (i + 0.5) / pieces);
                if (!(normal.dot(plane->normal()) > least)) {
                    return std::nullopt;
                }
            }
        }
    }
    return plane;
}

/// A point of the surface of \p face on the line through \p x along the unit vector \p direction, the one that Newton's
/// method finds from the point of the surface next to x. Where the surface is steep or missed, that point. A few
/// closest points.
template <brep B>
[[nodiscard]] Vec3 lift_to_face(const B& b, FaceId face, const Vec3& x, const Vec3& direction) {
    Vec3 at = x;
    Vec3 first = x;
    double last_off = HUGE_VAL;
    for (int iteration = 0; iteration < 20; ++iteration) {
        const Vec2 uv = b.closest_on_face(face, at);
        const Vec3 foot = b.face_point(face, uv);
        first = iteration == 0 ? foot : first;
        const Vec3 gap = foot - x;
        const double off = (gap - gap.dot(direction) * direction).norm();
        if (off <= 1e-12 * (x.norm() + gap.norm())) {
            return foot;
        }
        if (iteration > 8 && !(off < 0.5 * last_off)) {  // at the noise of the kernel, or lost
            return off <= 1e-6 * gap.norm() ? foot : first;
        }
        last_off = off;
        const auto [du, dv] = b.face_derivatives(face, uv);
        Vec3 normal = du.cross(dv);
        if (!(normal.norm() > 1e-9 * du.norm() * dv.norm())) {  // a pole
            normal = direction;
        }
        const double steep = normal.normalized().dot(direction);
        if (std::abs(steep) < 0.05) {
            return first;
        }
        at = x + normal.normalized().dot(gap) / steep * direction;
    }
    return first;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/cap_plane-inl.hpp>
#endif
