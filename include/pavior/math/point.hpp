#pragma once
/// \file
/// The point concept: anything with three coordinates behind operator[].

#include <Eigen/Core>

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace pavior {

/// Point or vector in space. Units are the user's.
using Vec3 = Eigen::Vector3d;
/// Point in a parameter plane.
using Vec2 = Eigen::Vector2d;

namespace detail {

template <std::size_t N>
using SizeConstant = std::integral_constant<std::size_t, N>;

/// How many coordinates the type P tells its values have; 3 where it tells nothing (pointers, vectors, own classes).
template <class P>
[[nodiscard]] constexpr std::size_t coordinate_count() {
    if constexpr (std::is_bounded_array_v<P>) {
        return std::extent_v<P>;
    } else if constexpr (requires { typename SizeConstant<std::tuple_size<P>::value>; }) {
        return std::tuple_size<P>::value;  // std::array, std::tuple
    } else if constexpr (requires { typename SizeConstant<std::size_t{P::SizeAtCompileTime}>; }) {
        return P::SizeAtCompileTime;  // Eigen, fixed
    } else if constexpr (requires { typename SizeConstant<std::size_t{P::Ambient_dimension::value}>; }) {
        return P::Ambient_dimension::value;  // CGAL
    } else if constexpr (requires { typename SizeConstant<std::size_t{P::extent}>; }) {
        return P::extent == static_cast<std::size_t>(-1) ? 3 : P::extent;  // std::span
    }
    return 3;
}

}  // namespace detail

/// A type P is point_like if, for a value p of it (references and const stripped):
/// 1. p[0], p[1], p[2] are convertible to double;
/// 2. its number of coordinates is 3 where the type tells it: arrays, std::array, spans, vectors of Eigen, CGAL points;
/// 3. (not checkable) they are its Cartesian coordinates, and reading them costs O(1). So is 2 for the others:
///    pointers, std::vector, classes of your own.
/// Models: std::array<double, 3>, const double*, Eigen::Vector3d/f, CGAL::Point_3.
template <class P>
concept point_like = (detail::coordinate_count<std::remove_cvref_t<P>>() == 3) &&
                     requires(const std::remove_cvref_t<P>& p) {
    { p[0] } -> std::convertible_to<double>;
    { p[1] } -> std::convertible_to<double>;
    { p[2] } -> std::convertible_to<double>;
};

namespace detail {

template <class R>
concept counted = std::is_bounded_array_v<R> || requires(const R& r) {
    { r.size() } -> std::convertible_to<std::size_t>;
};

template <class R>
[[nodiscard]] constexpr std::size_t count_of(const R& range) {
    if constexpr (std::is_bounded_array_v<R>) {
        return std::extent_v<R>;
    } else {
        return static_cast<std::size_t>(range.size());
    }
}

}  // namespace detail

/// R is a point_range if, for a const R& r, r.size() is convertible to std::size_t and r[i], 0 <= i < r.size(), is
/// point_like, at O(1) (not checkable). Built-in arrays of points are, too.
/// Models: std::vector<Vec3, A>, std::array<Vec3, N>, std::span<Vec3>, std::deque<const double*>.
template <class R>
concept point_range = detail::counted<std::remove_cvref_t<R>> &&
    requires(const std::remove_cvref_t<R>& r, std::size_t i) {
    { r[i] } -> point_like;
};

/// Copies a point.
template <point_like P>
[[nodiscard]] Vec3 to_vec3(const P& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace pavior
