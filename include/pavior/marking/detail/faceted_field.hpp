#pragma once
/// \file
/// Surfaces that follow their triangles where these are near.

#include <pavior/marking/detail/near_triangles.hpp>
#include <pavior/marking/patch_surface.hpp>
#include <pavior/math/point.hpp>

#include <cmath>

namespace pavior {

namespace detail {

/// A curved surface that becomes the planes of the triangles that it was fitted to where it comes close to them, since
/// the solid is bounded by the triangles. The sides of points beside the triangles are those of their planes.
struct FacetedField {
    PatchSurface surface;
    NearTriangles triangles;

    [[nodiscard]] double operator()(const Vec3& x) const {
        const double value = surface.distance(x);
        const double band = 4 * surface.sagitta;
        if (!(std::abs(value) <= band + surface.sagitta)) {
            return value;
        }
        const NearTriangles::Hit hit = triangles.nearest(x, band * band);
        if (!(hit.square < band * band)) {
            return value;
        }
        const double far = hit.square / (band * band);
        return (1 - far) * hit.height + far * value;
    }
};

}  // namespace detail

}  // namespace pavior
