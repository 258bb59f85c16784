#pragma once

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/polygon_body.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE PolygonBody::PolygonBody(std::vector<PolygonCap> caps, const PolygonBodyOptions& options)
    : caps_(std::move(caps)) {
    body_.frame = options.frame;
    for (std::size_t c = 0; c < caps_.size(); ++c) {
        check(c);
        ExtrudedCap cap{{}, caps_[c].below, caps_[c].above, static_cast<int>(c)};
        for (const std::vector<Vec2>& loop : caps_[c].loops) {
            add_loop(static_cast<Index>(c), loop, options.corner_angle * std::numbers::pi / 180, cap);
        }
        body_.caps.push_back(std::move(cap));
    }
}

PAVIOR_INLINE Vec3 PolygonBody::curve_point(Index curve, const Vec2& near) const {
    const std::span<const Vec2> line = body_.plane[curve];
    double least = std::numeric_limits<double>::infinity();
    Vec2 best = line.front();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 along = line[i + 1] - line[i];
        const double t = std::clamp((near - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const Vec2 at = line[i] + t * along;
        if ((at - near).squaredNorm() < least) {
            least = (at - near).squaredNorm();
            best = at;
        }
    }
    return {best[0], best[1], cap_height(cap_of_curve_[curve], best)};
}

namespace detail {

/// The first point of a closed polygon in the place of the one before it, up to the rounding of the coordinates; its
/// size if there is none.
[[nodiscard]] PAVIOR_INLINE std::size_t repeated_point(std::span<const Vec2> loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2& before = loop[i == 0 ? loop.size() - 1 : i - 1];
        const double rounding = 8 * std::numeric_limits<double>::epsilon() * loop[i].cwiseAbs().maxCoeff();
        if ((loop[i] - before).cwiseAbs().maxCoeff() <= rounding) {
            return i;
        }
    }
    return loop.size();
}

}  // namespace detail

PAVIOR_INLINE void PolygonBody::check(std::size_t c) const {
    const Error::Ids ids{static_cast<std::int64_t>(c)};
    bool small = caps_[c].loops.empty();
    for (const std::vector<Vec2>& loop : caps_[c].loops) {
        small = small || loop.size() < 3;
        if (!std::all_of(loop.begin(), loop.end(), [](const Vec2& x) { return x.allFinite(); })) {
            throw InputError(ErrorCode::not_finite, "cap " + std::to_string(c) + " has a point that is not finite",
                             ids);
        }
    }
    if (small) {
        throw InputError(ErrorCode::empty_input, "cap " + std::to_string(c) + " has a loop without area", ids);
    }
    for (std::size_t l = 0; l < caps_[c].loops.size(); ++l) {
        const std::vector<Vec2>& loop = caps_[c].loops[l];
        const std::size_t i = detail::repeated_point(loop);
        if (i < loop.size()) {
            throw InputError(
                ErrorCode::duplicate_node,
                "cap " + std::to_string(c) + ": point " + std::to_string(i) + " of loop " + std::to_string(l) +
                    " lies where the one before it does",
                {static_cast<std::int64_t>(c), static_cast<std::int64_t>(l), static_cast<std::int64_t>(i)});
        }
    }
}

PAVIOR_INLINE void PolygonBody::add_loop(Index cap, const std::vector<Vec2>& loop, double corner_angle,
                                         ExtrudedCap& result) {
    const std::size_t n = loop.size();
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = loop[i] - loop[(i + n - 1) % n];
        const Vec2 out = loop[(i + 1) % n] - loop[i];
        if (std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out))) > corner_angle) {
            corners.push_back(i);
        }
    }
    if (corners.empty()) {
        corners.push_back(0);
    }
    const auto first_vertex = static_cast<Index>(body_.vertices.size());
    for (const std::size_t i : corners) {
        add_vertex(cap, loop[i]);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::size_t next = (k + 1) % corners.size();
        std::vector<Vec2> line{loop[corners[k]]};
        for (std::size_t i = (corners[k] + 1) % n; i != corners[next]; i = (i + 1) % n) {
            line.push_back(loop[i]);
        }
        line.push_back(loop[corners[next]]);
        result.curves.push_back(static_cast<Index>(body_.curves.size()));
        body_.curves.push_back({{static_cast<Index>(first_vertex + k), static_cast<Index>(first_vertex + next)},
                                0,
                                static_cast<int>(body_.curves.size())});
        body_.plane.add(line);
        cap_of_curve_.push_back(cap);
    }
}

}  // namespace pavior
