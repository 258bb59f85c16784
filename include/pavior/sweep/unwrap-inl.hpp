#pragma once

#include <pavior/math/box.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <cmath>
#include <cstddef>
#include <span>

namespace pavior {

PAVIOR_INLINE Vec2 nearest_image_shift(const Vec2& p, const Vec2& near, const Periods& periods) {
    Vec2 shift = Vec2::Zero();
    for (int axis = 0; axis < 2; ++axis) {
        const double period = periods[static_cast<std::size_t>(axis)];
        if (period > 0.0) {
            const double turns = (near[axis] - p[axis]) / period;
            const double whole = std::ceil(std::abs(turns) - 0.5 - 1e-9);
            shift[axis] = whole > 0.0 ? std::copysign(whole, turns) * period : 0.0;
        }
    }
    return shift;
}

namespace detail {

inline void note_gap(UnwrapReport& report, const Vec2& gap, double tolerance) {
    if (!(gap.norm() <= report.gap.norm())) {
        report.gap = gap;
    }
    report.closed = report.closed && gap.norm() <= tolerance;
}

inline void shift_chain(std::span<Vec2> chain, const Vec2& shift) {
    if (shift != Vec2::Zero()) {
        for (Vec2& p : chain) {
            p += shift;
        }
    }
}

}  // namespace detail

PAVIOR_INLINE UnwrapReport unwrap_loop(std::span<const std::span<Vec2>> chains, const Periods& periods,
                                       double tolerance) {
    UnwrapReport report;
    const Vec2* first = nullptr;
    const Vec2* last = nullptr;
    for (const std::span<Vec2> chain : chains) {
        if (chain.empty()) {
            continue;
        }
        if (last != nullptr) {
            detail::shift_chain(chain, nearest_image_shift(chain.front(), *last, periods));
            detail::note_gap(report, chain.front() - *last, tolerance);
        } else {
            first = &chain.front();
        }
        last = &chain.back();
    }
    if (first != nullptr) {
        detail::note_gap(report, *first - *last, tolerance);
    }
    return report;
}

PAVIOR_INLINE UnwrapReport unwrap_sides(std::span<Vec2> bottom, std::span<Vec2> top, std::span<Vec2> left,
                                        std::span<Vec2> right, const Periods& periods, double tolerance) {
    UnwrapReport report;
    if (bottom.empty() || top.empty() || left.empty() || right.empty()) {
        report.closed = false;
        return report;
    }
    detail::shift_chain(right, nearest_image_shift(right.front(), bottom.back(), periods));
    detail::shift_chain(top, nearest_image_shift(top.back(), right.back(), periods));
    detail::shift_chain(left, nearest_image_shift(left.back(), top.front(), periods));
    detail::note_gap(report, right.front() - bottom.back(), tolerance);
    detail::note_gap(report, top.back() - right.back(), tolerance);
    detail::note_gap(report, left.back() - top.front(), tolerance);
    detail::note_gap(report, bottom.front() - left.front(), tolerance);
    return report;
}

PAVIOR_INLINE bool inside_polygon(const Vec2& p, std::span<const Vec2> polygon) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
            inside = !inside;
        }
    }
    return inside;
}

PAVIOR_INLINE Vec2 inside_shift(const Vec2& p, std::span<const Vec2> polygon, const Periods& periods) {
    if (polygon.empty()) {
        return Vec2::Zero();
    }
    const Box<Vec2> box = box_round(polygon);
    const Vec2 next = nearest_image_shift(p, 0.5 * (box.low + box.high), periods);
    for (const double du : {0.0, -1.0, 1.0}) {
        for (const double dv : {0.0, -1.0, 1.0}) {
            const Vec2 shift = next + Vec2(du * periods[0], dv * periods[1]);
            if (inside_polygon(p + shift, polygon)) {
                return shift;
            }
        }
    }
    return next;
}

}  // namespace pavior
