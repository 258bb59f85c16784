#pragma once
/// \file
/// Any parametric surface behind one type, so that what takes it is compiled once.

#include <pavior/math/parametric_surface.hpp>
#include <pavior/math/point.hpp>

#include <concepts>
#include <utility>

namespace pavior {

/// A view of a surface, two words and a pointer; models parametric_surface. Made from any parametric_surface, to which
/// it keeps a reference: as a parameter of functions it also takes a temporary. A call costs what the surface takes and
/// an indirect call. As thread-safe as the surface.
class AnySurface {
public:
    template <class S>
    requires(!std::same_as<S, AnySurface> && parametric_surface<S>)
        AnySurface(const S& surface)  // NOLINT: a surface is passed as it is
        : surface_(&surface),
          point_([](const void* s, const Vec2& uv) -> Vec3 { return static_cast<const S*>(s)->point(uv); }),
          derivatives_([](const void* s, const Vec2& uv) -> std::pair<Vec3, Vec3> {
              return static_cast<const S*>(s)->derivatives(uv);
          }) {}

    [[nodiscard]] Vec3 point(const Vec2& uv) const { return point_(surface_, uv); }
    [[nodiscard]] std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const { return derivatives_(surface_, uv); }

private:
    const void* surface_;
    Vec3 (*point_)(const void*, const Vec2&);
    std::pair<Vec3, Vec3> (*derivatives_)(const void*, const Vec2&);
};

static_assert(parametric_surface<AnySurface>);

}  // namespace pavior
