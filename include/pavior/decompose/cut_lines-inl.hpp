#pragma once

#include <pavior/decompose/cut_lines.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace pavior {

namespace detail {

struct SideOfSurface {
    const Vec3& x;

    double operator()(const CutPlane& s) const { return (x - s.point).dot(s.normal); }
    double operator()(const CutHalfPlane& s) const {
        return (x - s.point).dot(s.into) < 0 ? 0.0 : (x - s.point).dot(s.along.cross(s.into));
    }
    double operator()(const CutCylinder& s) const { return distance_to_line(x, {s.point, s.direction}) - s.radius; }
};

struct SameSurface {
    double tolerance;

    bool operator()(const CutPlane& a, const CutPlane& b) const {
        return a.normal.cross(b.normal).norm() < 1e-6 && std::abs((b.point - a.point).dot(a.normal)) < tolerance;
    }
    bool operator()(const CutHalfPlane& a, const CutHalfPlane& b) const {
        return a.along.cross(b.along).norm() < 1e-6 && (a.into - b.into).norm() < 1e-6 &&
               distance_to_line(b.point, {a.point, a.along}) < tolerance;
    }
    bool operator()(const CutCylinder& a, const CutCylinder& b) const {
        return a.direction.cross(b.direction).norm() < 1e-6 && std::abs(a.radius - b.radius) < tolerance &&
               distance_to_line(b.point, {a.point, a.direction}) < tolerance;
    }
    template <class A, class B>
    bool operator()(const A&, const B&) const {
        return false;
    }
};

}  // namespace detail

PAVIOR_INLINE std::optional<Vec3> common_point(const Axis& a, const Axis& b, double tolerance) {
    const Vec3 n = a.direction.cross(b.direction);
    if (n.norm() < 1e-3) {
        return std::nullopt;
    }
    const Vec3 between = b.origin - a.origin;
    if (std::abs(between.dot(n)) > tolerance * n.norm()) {
        return std::nullopt;
    }
    const double on_a = between.cross(b.direction).dot(n) / n.squaredNorm();
    const double on_b = between.cross(a.direction).dot(n) / n.squaredNorm();
    return 0.5 * (a.origin + on_a * a.direction + b.origin + on_b * b.direction);
}

PAVIOR_INLINE double signed_distance(const CutSurface& surface, const Vec3& x) {
    return std::visit(detail::SideOfSurface{x}, surface);
}

PAVIOR_INLINE bool same_surface(const CutSurface& a, const CutSurface& b, double tolerance) {
    return std::visit(detail::SameSurface{tolerance}, a, b);
}

PAVIOR_INLINE std::optional<Vec3> circle_centre(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const Vec3 w = u.cross(v);
    if (!(w.norm() > 1e-9 * u.norm() * v.norm())) {
        return std::nullopt;
    }
    return a + (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u)) / (2 * w.squaredNorm());
}

PAVIOR_INLINE double distance_to_curve(const Vec3& x, const CutCurve& curve) {
    const std::optional<Vec3> found = circle_centre(curve.from, curve.middle, curve.to);
    if (!found) {
        const Vec3 way = curve.to - curve.from;
        const double part = std::clamp((x - curve.from).dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
        return (x - curve.from - part * way).norm();
    }
    const Vec3& centre = *found;
    const Vec3 n = (curve.middle - curve.from).cross(curve.to - curve.from).normalized();
    const Vec3 in_plane = x - centre - (x - centre).dot(n) * n;
    const bool between =
        (curve.from - centre).cross(in_plane).dot(n) >= 0 && in_plane.cross(curve.to - centre).dot(n) >= 0;
    if (!between) {
        return std::min((x - curve.from).norm(), (x - curve.to).norm());
    }
    return std::hypot(in_plane.norm() - (curve.from - centre).norm(), (x - centre).dot(n));
}

}  // namespace pavior
