#pragma once
/// \file
/// A smooth surface behind a set of boundary triangles: plane, cylinder, cone, sphere, torus, or moving least squares
/// of the triangles' planes. Signed distances continue it into the solid; fit_surface() finds it.

#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

/// What a surface is.
enum class SurfaceKind : std::uint8_t { plane, cylinder, cone, sphere, torus, facets };

/// A triangle as the fits see it: centroid, unit normal out of the solid, area.
struct Facet {
    Vec3 centre{0, 0, 0};
    Vec3 normal{0, 0, 1};
    double area = 0.0;
};

/// A surface with a side: distance() is positive where the outward normals of its triangles point.
struct PatchSurface {
    SurfaceKind kind = SurfaceKind::plane;
    Vec3 point{0, 0, 0};        ///< on the plane, on the axis, or centre (cone: apex)
    Vec3 axis{0, 0, 1};         ///< normal of the plane (outward), or unit axis
    double radius = 0.0;        ///< cylinder, sphere, torus (of the circle of centres); cone: tangent of half its angle
    double tube = 0.0;          ///< torus: radius of the tube
    double sense = 1.0;         ///< -1 if the outward normals point at the axis or centre
    double sagitta = 0.0;       ///< how far points of the triangles are from the surface
    std::vector<Facet> facets;  ///< kind facets only

    /// Signed distance of \p x; for a cone that along its normal, for facets a weighted mean of those to their planes.
    [[nodiscard]] double distance(const Vec3& x) const;
    /// Unit normal at \p x, the direction in which distance() grows; at a singular point any unit vector.
    [[nodiscard]] Vec3 normal(const Vec3& x) const;
};

namespace detail {

/// Height along and distance from an axis.
struct AxisPoint {
    double height = 0.0;
    double radius = 0.0;
    Vec3 out{0, 0, 0};  ///< unit, away from the axis
};
[[nodiscard]] inline AxisPoint about_axis(const PatchSurface& s, const Vec3& x) {
    const Vec3 d = x - s.point;
    const double height = s.axis.dot(d);
    const Vec3 across = d - height * s.axis;
    const double radius = across.norm();
    return {height, radius, radius > 0 ? Vec3(across / radius) : s.axis.unitOrthogonal()};
}

/// Moving least squares: value and mean normal.
struct FacetMean {
    double distance = 0.0;
    Vec3 normal{0, 0, 0};
};
[[nodiscard]] inline FacetMean facet_mean(std::span<const Facet> facets, const Vec3& x) {
    FacetMean mean;
    double total = 0;
    for (const Facet& f : facets) {
        const Vec3 d = x - f.centre;
        const double soft = d.squaredNorm() + 0.05 * f.area;
        const double w = f.area / (soft * soft);
        mean.distance += w * f.normal.dot(d);
        mean.normal += w * f.normal;
        total += w;
    }
    const double norm = mean.normal.norm();
    mean.distance /= norm > 0.1 * total ? norm : total;
    mean.normal = norm > 0 ? Vec3(mean.normal / norm) : Vec3(0, 0, 1);
    return mean;
}

}  // namespace detail

inline double PatchSurface::distance(const Vec3& x) const {
    if (kind == SurfaceKind::plane) {
        return axis.dot(x - point);
    }
    if (kind == SurfaceKind::sphere) {
        return sense * ((x - point).norm() - radius);
    }
    if (kind == SurfaceKind::facets) {
        return detail::facet_mean(facets, x).distance;
    }
    const detail::AxisPoint p = detail::about_axis(*this, x);
    if (kind == SurfaceKind::cylinder) {
        return sense * (p.radius - radius);
    }
    if (kind == SurfaceKind::cone) {
        return sense * (p.radius - radius * p.height) / std::hypot(1.0, radius);
    }
    return sense * (std::hypot(p.radius - radius, p.height) - tube);
}

inline Vec3 PatchSurface::normal(const Vec3& x) const {
    if (kind == SurfaceKind::plane) {
        return axis;
    }
    if (kind == SurfaceKind::facets) {
        return detail::facet_mean(facets, x).normal;
    }
    if (kind == SurfaceKind::sphere) {
        const Vec3 d = x - point;
        const double norm = d.norm();
        return norm > 0 ? Vec3(sense * d / norm) : axis;
    }
    const detail::AxisPoint p = detail::about_axis(*this, x);
    if (kind == SurfaceKind::cylinder) {
        return sense * p.out;
    }
    if (kind == SurfaceKind::cone) {
        return sense * (p.out - radius * axis) / std::hypot(1.0, radius);
    }
    const Vec3 d = (p.radius - radius) * p.out + p.height * axis;
    const double norm = d.norm();
    return norm > 0 ? Vec3(sense * d / norm) : axis;
}

}  // namespace pavior
