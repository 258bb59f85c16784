#pragma once
/// \file
/// One face of a CAD model as a parametric surface.

#include <pavior/brep/brep.hpp>

#include <utility>

namespace pavior {

/// The surface of face `face` of `*model`; a view, as cheap to copy as two words. Models parametric_surface.
template <brep B>
struct FaceSurface {
    const B* model;
    FaceId face;

    [[nodiscard]] Vec3 point(const Vec2& uv) const { return model->face_point(face, uv); }
    [[nodiscard]] std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const { return model->face_derivatives(face, uv); }
    /// Parameters of a point of the surface next to \p x.
    [[nodiscard]] Vec2 closest(const Vec3& x) const { return model->closest_on_face(face, x); }
};

}  // namespace pavior
