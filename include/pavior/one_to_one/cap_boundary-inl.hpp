#pragma once

#include <pavior/one_to_one/cap_boundary.hpp>

#include <cstddef>
#include <span>

namespace pavior {

namespace detail {

PAVIOR_INLINE double twice_area(std::span<const Vec2> loop) {
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2& a = loop[i];
        const Vec2& b = loop[(i + 1) % loop.size()];
        area += a.x() * b.y() - a.y() * b.x();
    }
    return area;
}

}  // namespace detail

}  // namespace pavior
