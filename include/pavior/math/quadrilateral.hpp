#pragma once
/// \file
/// The bilinear quadrilateral in space and in the plane: normals, areas, flux, quality.

#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pavior {

/// Corners of a quadrilateral in space, counter-clockwise seen from the tip of its normal.
using QuadPoints = std::array<Vec3, 4>;
/// Corners of a quadrilateral in the plane, counter-clockwise if it is positive.
using QuadPoints2 = std::array<Vec2, 4>;

/// Vector area: half the cross product of the diagonals. Exact for the bilinear surface, any surface with these edges.
[[nodiscard]] inline Vec3 quad_vector_area(const QuadPoints& x) { return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]); }

/// Normal of length 1; null if the vector area is null or not finite.
[[nodiscard]] inline Vec3 quad_normal(const QuadPoints& x) {
    const Vec3 area = quad_vector_area(x);
    const double length = area.stableNorm();
    return length > 0.0 && std::isfinite(length) ? Vec3(area / length) : Vec3(Vec3::Zero());
}

/// Normals at the corners, as long as the parallelogram of the two edges there is large (null where they are parallel).
[[nodiscard]] inline std::array<Vec3, 4> quad_corner_normals(const QuadPoints& x) {
    return {(x[1] - x[0]).cross(x[3] - x[0]), (x[2] - x[1]).cross(x[0] - x[1]), (x[3] - x[2]).cross(x[1] - x[2]),
            (x[0] - x[3]).cross(x[2] - x[3])};
}

/// Signed areas of the corner parallelograms, seen from the tip of \p normal (length 1).
[[nodiscard]] inline std::array<double, 4> quad_corner_areas(const QuadPoints& x, const Vec3& normal) {
    const auto n = quad_corner_normals(x);
    return {n[0].dot(normal), n[1].dot(normal), n[2].dot(normal), n[3].dot(normal)};
}

/// As above for the quadrilateral's own normal.
[[nodiscard]] inline std::array<double, 4> quad_corner_areas(const QuadPoints& x) {
    return quad_corner_areas(x, quad_normal(x));
}

/// In the plane.
[[nodiscard]] inline std::array<double, 4> quad_corner_areas(const QuadPoints2& x) {
    std::array<double, 4> areas{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 a = x[(i + 1) % 4] - x[i];
        const Vec2 b = x[(i + 3) % 4] - x[i];
        areas[i] = a.x() * b.y() - a.y() * b.x();
    }
    return areas;
}

/// Flux of the field x/3 through the bilinear quadrilateral, along its normal: the signed volume of the cone over it
/// from the origin. Exact (mean of the two triangulations). Summed over a closed surface: the volume inside.
[[nodiscard]] inline double quad_flux(const QuadPoints& x) {
    const Vec3 s = x[1] - x[0];
    const Vec3 t = x[2] - x[0];
    const Vec3 r = x[3] - x[0];
    // Four tetrahedra with the origin, halved: (012) + (023) + (013) + (123).
    return (x[0].dot(s.cross(t) + t.cross(r) + s.cross(r)) + x[1].dot((x[2] - x[1]).cross(x[3] - x[1]))) / 12.0;
}

/// Quality of one quadrilateral, each 1 for a square. Independent of the scale; 0, 0 for not finite coordinates.
struct QuadMetrics {
    double shape = 0.0;            ///< see quad_shape()
    double scaled_jacobian = 0.0;  ///< see quad_scaled_jacobian()
};

namespace detail {
template <class Points>
[[nodiscard]] QuadMetrics quad_metrics(const Points& x, const std::array<double, 4>& areas) {
    std::array<double, 4> squares{};
    for (std::size_t i = 0; i < 4; ++i) {
        squares[i] = (x[(i + 1) % 4] - x[i]).squaredNorm();
    }
    QuadMetrics metrics{1.0, 1.0};
    bool collapsed = false;
    for (std::size_t i = 0; i < 4; ++i) {
        const double before = squares[(i + 3) % 4];
        const double lengths = std::sqrt(before) * std::sqrt(squares[i]);
        collapsed |= !(lengths > 0.0) || !std::isfinite(areas[i]);
        metrics.shape = std::min(metrics.shape, 2.0 * areas[i] / (before + squares[i]));
        metrics.scaled_jacobian = std::min(metrics.scaled_jacobian, areas[i] / lengths);
    }
    metrics.shape = std::max(metrics.shape, 0.0);
    return collapsed ? QuadMetrics{} : metrics;
}

/// x about its first corner, times a power of two that makes squares of edges safe; exact.
template <class Points>
[[nodiscard]] Points quad_in_range(const Points& x) {
    double size = 0.0;
    for (const auto& p : x) {
        size = std::max(size, (p - x[0]).cwiseAbs().maxCoeff());
    }
    if ((size > 1e-60 && size < 1e60) || !(size > 0.0) || !std::isfinite(size)) {
        return x;
    }
    const double factor = std::ldexp(1.0, -std::ilogb(size));
    Points scaled = x;
    for (auto& p : scaled) {
        p = (p - x[0]) * factor;
    }
    return scaled;
}
}  // namespace detail

/// Both metrics in space, seen from the tip of \p normal (length 1).
[[nodiscard]] inline QuadMetrics quad_metrics(const QuadPoints& x, const Vec3& normal) {
    const QuadPoints scaled = detail::quad_in_range(x);
    return detail::quad_metrics(scaled, quad_corner_areas(scaled, normal));
}
/// In space, seen from the tip of the quadrilateral's own normal.
[[nodiscard]] inline QuadMetrics quad_metrics(const QuadPoints& x) {
    const QuadPoints scaled = detail::quad_in_range(x);
    return detail::quad_metrics(scaled, quad_corner_areas(scaled));
}
/// In the plane.
[[nodiscard]] inline QuadMetrics quad_metrics(const QuadPoints2& x) {
    const QuadPoints2 scaled = detail::quad_in_range(x);
    return detail::quad_metrics(scaled, quad_corner_areas(scaled));
}

/// "Shape" of Verdict: min over the corners of twice the corner area by the sum of the squares of its two edges (mean
/// ratio). In (0, 1]; 0 if a corner area is <= 0.
[[nodiscard]] inline double quad_shape(const QuadPoints& x) { return quad_metrics(x).shape; }
[[nodiscard]] inline double quad_shape(const QuadPoints2& x) { return quad_metrics(x).shape; }

/// "Scaled Jacobian" of Verdict: min over the corners of the corner area by the lengths of its two edges, the smallest
/// sine. In [-1, 1]; 0 where an edge has collapsed.
[[nodiscard]] inline double quad_scaled_jacobian(const QuadPoints& x) { return quad_metrics(x).scaled_jacobian; }
[[nodiscard]] inline double quad_scaled_jacobian(const QuadPoints2& x) { return quad_metrics(x).scaled_jacobian; }

/// True if a corner area is not positive: the bilinear map folds, seen from the tip of \p normal. NaN counts as folded.
[[nodiscard]] inline bool quad_inverted(const QuadPoints& x, const Vec3& normal) {
    const auto areas = quad_corner_areas(x, normal);
    return !std::all_of(areas.begin(), areas.end(), [](double a) { return a > 0.0; });
}
[[nodiscard]] inline bool quad_inverted(const QuadPoints& x) { return quad_inverted(x, quad_normal(x)); }
[[nodiscard]] inline bool quad_inverted(const QuadPoints2& x) {
    const auto areas = quad_corner_areas(x);
    return !std::all_of(areas.begin(), areas.end(), [](double a) { return a > 0.0; });
}

}  // namespace pavior
