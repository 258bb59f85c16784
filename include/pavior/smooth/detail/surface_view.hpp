#pragma once
/// \file
/// Any parametric_surface behind one type, so that what works with it is compiled once.

#include <pavior/math/parametric_surface.hpp>
#include <pavior/math/point.hpp>

#include <utility>

namespace pavior::detail {

/// The parametric_surface that refers to another, which must outlive it; a call through a pointer for each question.
class SurfaceView {
public:
    template <parametric_surface S>
    explicit SurfaceView(const S& surface)
        : surface_(&surface),
          point_([](const void* s, const Vec2& uv) { return Vec3(static_cast<const S*>(s)->point(uv)); }),
          derivatives_([](const void* s, const Vec2& uv) {
              return std::pair<Vec3, Vec3>(static_cast<const S*>(s)->derivatives(uv));
          }) {}

    [[nodiscard]] Vec3 point(const Vec2& uv) const { return point_(surface_, uv); }
    [[nodiscard]] std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const { return derivatives_(surface_, uv); }

private:
    const void* surface_;
    Vec3 (*point_)(const void*, const Vec2&);
    std::pair<Vec3, Vec3> (*derivatives_)(const void*, const Vec2&);
};

}  // namespace pavior::detail
