#pragma once
/// \file
/// How pavior reads the boundary points of the levels of a sweep.

#include <pavior/math/point.hpp>

#include <concepts>
#include <cstddef>
#include <ranges>
#include <span>
#include <type_traits>

namespace pavior {

/// The boundary points of all levels, one after the other in one array: point i of level k is
/// points[k * level_size + i]. Copies nothing.
template <point_like P = Vec3>
struct LevelArray {
    std::span<const P> points;
    std::size_t level_size = 0;
};

/// How pavior reads the boundary levels of type L. Specialise it for your type with these static members:
///
///     static std::size_t level_count(const L&);                            // r + 1
///     static std::size_t point_count(const L&, std::size_t k);             // nodes of all loops
///     static point_like  point(const L&, std::size_t k, std::size_t i);
///
/// Nested ranges (a vector of vectors of points) and LevelArray need none.
template <class L>
struct level_access;

/// L is a level_points if level_access<L>
/// 1. has level_count(l), the number of levels including both caps;
/// 2. has point_count(l, k), which must be the number of loop nodes for every level;
/// 3. has point(l, k, i), point_like: the place at level k of the i-th node of the concatenated loops;
/// 4. (not checkable) all are O(1) and do not change l.
template <class L>
concept level_points = requires(const std::remove_cvref_t<L>& l, std::size_t k) {
    { level_access<std::remove_cvref_t<L>>::level_count(l) } -> std::convertible_to<std::size_t>;
    { level_access<std::remove_cvref_t<L>>::point_count(l, k) } -> std::convertible_to<std::size_t>;
    { level_access<std::remove_cvref_t<L>>::point(l, k, k) } -> point_like;
};

template <point_like P>
struct level_access<LevelArray<P>> {
    static std::size_t level_count(const LevelArray<P>& l) {
        return l.level_size == 0 ? 0 : (l.points.size() + l.level_size - 1) / l.level_size;
    }
    static std::size_t point_count(const LevelArray<P>& l, std::size_t k) {
        const std::size_t left = l.points.size() - k * l.level_size;
        return left < l.level_size ? left : l.level_size;
    }
    static const P& point(const LevelArray<P>& l, std::size_t k, std::size_t i) {
        return l.points[k * l.level_size + i];
    }
};

template <std::ranges::random_access_range L>
requires std::ranges::sized_range<L> && std::ranges::random_access_range<std::ranges::range_reference_t<const L>> &&
    std::ranges::sized_range<std::ranges::range_reference_t<const L>> &&
    point_like<std::ranges::range_reference_t<std::ranges::range_reference_t<const L>>>
struct level_access<L> {
    static std::size_t level_count(const L& l) { return std::ranges::size(l); }
    static std::size_t point_count(const L& l, std::size_t k) { return std::ranges::size(level(l, k)); }
    static decltype(auto) point(const L& l, std::size_t k, std::size_t i) {
        return std::ranges::begin(level(l, k))[static_cast<std::ptrdiff_t>(i)];
    }

private:
    static decltype(auto) level(const L& l, std::size_t k) {
        return std::ranges::begin(l)[static_cast<std::ptrdiff_t>(k)];
    }
};

}  // namespace pavior
