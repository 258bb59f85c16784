#pragma once
/// \file
/// The concept of a parametric surface: what algorithms on CAD faces need to evaluate.

#include <pavior/math/point.hpp>

#include <concepts>
#include <type_traits>
#include <utility>

namespace pavior {

/// S is a parametric_surface if, for a const S& s and a Vec2 uv,
/// 1. s.point(uv) is convertible to Vec3: the point psi(u, v);
/// 2. s.derivatives(uv) is convertible to std::pair<Vec3, Vec3>: d/du and d/dv there;
/// 3. (not checkable) both are defined on a neighbourhood of the trimmed face, deterministic and const; the surface is
///    continuously differentiable, its normal is d/du x d/dv.
/// Thread-safety is not required: algorithms call a surface from one thread.
template <class S>
concept parametric_surface = requires(const std::remove_cvref_t<S>& s, const Vec2& uv) {
    { s.point(uv) } -> std::convertible_to<Vec3>;
    { s.derivatives(uv) } -> std::convertible_to<std::pair<Vec3, Vec3>>;
};

}  // namespace pavior
