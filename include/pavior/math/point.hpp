#pragma once
/// \file
/// The point concept: anything with three coordinates behind operator[].

#include <Eigen/Core>

#include <concepts>
#include <type_traits>

namespace pavior {

/// Point or vector in space. Units are the user's.
using Vec3 = Eigen::Vector3d;
/// Point in a parameter plane.
using Vec2 = Eigen::Vector2d;

/// A type P is point_like if, for a value p of it (references and const stripped):
/// 1. p[0], p[1], p[2] are convertible to double;
/// 2. (not checkable) they are its Cartesian coordinates, and reading them costs O(1).
/// Models: std::array<double, 3>, const double*, Eigen::Vector3d/f, CGAL::Point_3.
template <class P>
concept point_like = requires(const std::remove_cvref_t<P>& p) {
    { p[0] } -> std::convertible_to<double>;
    { p[1] } -> std::convertible_to<double>;
    { p[2] } -> std::convertible_to<double>;
};

/// Copies a point.
template <point_like P>
[[nodiscard]] Vec3 to_vec3(const P& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace pavior
