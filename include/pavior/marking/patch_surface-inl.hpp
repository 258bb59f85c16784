#pragma once

#include <pavior/marking/patch_surface.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <span>

namespace pavior {

namespace detail {

PAVIOR_INLINE AxisPoint about_axis(const PatchSurface& s, const Vec3& x) {
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

PAVIOR_INLINE double PatchSurface::distance(const Vec3& x) const {
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

PAVIOR_INLINE Vec3 PatchSurface::normal(const Vec3& x) const {
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
