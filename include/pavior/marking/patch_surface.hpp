#pragma once
/// \file
/// A smooth surface behind a set of boundary triangles: plane, cylinder, cone, sphere, torus, or moving least squares
/// of the triangles' planes. Signed distances continue it into the solid; fit_surface() finds it.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>

#include <cstdint>
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

[[nodiscard]] PAVIOR_INLINE AxisPoint about_axis(const PatchSurface& s, const Vec3& x);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/patch_surface-inl.hpp>
#endif
