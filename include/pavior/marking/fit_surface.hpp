#pragma once
/// \file
/// Fits the smooth surface behind a set of boundary triangles: plane, cylinder, sphere, cone or torus where one fits.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/patch_surface.hpp>
#include <pavior/math/point.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace pavior {

namespace detail {

/// The centre and covariance (area-weighted) of the normals or of the centres.
[[nodiscard]] PAVIOR_INLINE Vec3 mean_centre(std::span<const Facet> facets);

[[nodiscard]] PAVIOR_INLINE Vec3 mean_normal(std::span<const Facet> facets);

/// A fit holds if all points are within `tolerance` and the normals of the triangles agree within some 25 degrees.
[[nodiscard]] inline bool fit_holds(const PatchSurface& s, std::span<const Facet> facets, std::span<const Vec3> points,
                                    double tolerance) {
    const auto near = [&](const Vec3& x) { return std::abs(s.distance(x)) <= tolerance; };
    const auto along = [&](const Facet& f) { return s.normal(f.centre).dot(f.normal) >= 0.9; };
    return std::all_of(points.begin(), points.end(), near) && std::all_of(facets.begin(), facets.end(), along);
}

/// Circle through points of a plane, algebraic least squares: centre and radius.
struct Circle {
    Vec2 centre{0, 0};
    double radius = 0.0;
};

[[nodiscard]] PAVIOR_INLINE std::optional<Circle> fit_circle(std::span<const Vec2> points);

/// The axis that the normals of a surface of revolution meet: least squares of their moments about it.
/// \return point (nearest to the mean of the points) and direction
[[nodiscard]] PAVIOR_INLINE std::optional<std::pair<Vec3, Vec3>> axis_of_revolution(std::span<const Facet> facets);

}  // namespace detail

/// The simplest surface that passes within \p tolerance (a length) of \p points, the nodes that are on the true
/// surface, and along the triangles \p facets; kind facets if none does. Two circles are on a cone and on a sphere: the
/// one closer to the triangles counts. Not empty; facets have area.
/// O(n); the triangles are copied for kind facets.
[[nodiscard]] PAVIOR_INLINE PatchSurface fit_surface(std::span<const Facet> facets, std::span<const Vec3> points,
                                                     double tolerance);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/fit_surface-inl.hpp>
#endif
