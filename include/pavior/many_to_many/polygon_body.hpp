#pragma once
/// \file
/// An extruded body from polygons at levels, without CAD.

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/extruded_body.hpp>

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

/// A cap of a body: a region of the plane at a level. Heights are level + slope . point.
struct PolygonCap {
    std::vector<std::vector<Vec2>> loops;  ///< closed polygons, the first point not repeated; either sense
    double level = 0;
    Vec2 slope = Vec2::Zero();
    Index below = no_index, above = no_index;  ///< solids on its two sides, no_index: none
};

struct PolygonBodyOptions {
    ExtrusionFrame frame;
    /// Points where a polygon turns by more than this are nodes of the mesh, degrees; between them it is a smooth curve
    /// that is divided anew. 0: all points are nodes.
    double corner_angle = 20;
};

/// The caps of solids as an extruded body with its geometry. Models extruded_geometry. Tags are positions in the list
/// of caps and numbers of curves. The body names no sides, so multi_sweep() leaves them unnamed, and a merging
/// tolerance is not checked against walls and slots that it would close: set MultiSweepOptions::merge below their
/// width.
class PolygonBody {
public:
    /// \throws InputError empty_input (a cap without loops, a loop of fewer than three points), not_finite
    explicit PolygonBody(std::vector<PolygonCap> caps, const PolygonBodyOptions& options = {})
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

    [[nodiscard]] const ExtrudedBody& body() const { return body_; }

    [[nodiscard]] double cap_height(Index cap, const Vec2& at) const {
        return caps_[cap].level + caps_[cap].slope.dot(at);
    }
    [[nodiscard]] Vec3 curve_point(Index curve, const Vec2& near) const {
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

private:
    void check(std::size_t c) const {
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
    }

    Index add_vertex(Index cap, const Vec2& at) {
        body_.vertices.emplace_back(at[0], at[1], cap_height(cap, at));
        return static_cast<Index>(body_.vertices.size() - 1);
    }

    void add_loop(Index cap, const std::vector<Vec2>& loop, double corner_angle, ExtrudedCap& result) {
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

    std::vector<PolygonCap> caps_;
    ExtrudedBody body_;
    std::vector<Index> cap_of_curve_;
};

}  // namespace pavior
