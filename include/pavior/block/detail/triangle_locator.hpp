#pragma once
/// \file
/// Which triangle of a plane triangulation holds a point.

#include <pavior/math/box.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Triangles in the plane, filed in a regular grid. A query costs O(1) where they are of like sizes.
class TriangleLocator {
public:
    /// A triangle and the weights of its corners, none negative, of sum 1.
    struct Hit {
        std::size_t triangle = 0;
        Eigen::Vector3d weights = Eigen::Vector3d(1, 0, 0);
        double inside = -std::numeric_limits<double>::infinity();  ///< smallest weight before it was made positive
    };

    TriangleLocator() = default;
    TriangleLocator(std::vector<Vec2> uv, std::vector<TriCorners> triangles)
        : uv_(std::move(uv)), triangles_(std::move(triangles)) {
        build();
    }

    [[nodiscard]] const std::vector<Vec2>& uv() const { return uv_; }
    [[nodiscard]] const std::vector<TriCorners>& triangles() const { return triangles_; }

    /// The lowest triangle that holds \p p; outside of all, the one that p violates least, and its nearest place.
    [[nodiscard]] Hit locate(const Vec2& p) const {
        constexpr double tolerance = 1e-9;
        Hit hit;
        const std::size_t cell = column(p[1], 1) * cells_ + column(p[0], 0);
        for (std::size_t i = begin_[cell]; i < begin_[cell + 1] && hit.inside < 0.0; ++i) {
            improve(hit, listed_[i], p);
        }
        for (std::size_t t = 0; t < triangles_.size() && hit.inside < -tolerance; ++t) {
            improve(hit, t, p);
        }
        hit.weights = hit.weights.cwiseMax(0.0);
        hit.weights /= hit.weights.sum();
        return hit;
    }

private:
    [[nodiscard]] std::size_t column(double at, int axis) const {
        const double cell = (at - low_[axis]) / step_[axis];
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells_) - 1.0));
    }

    template <class Visit>
    void each_cell(const TriCorners& c, const Visit& visit) const {
        const Vec2 low = uv_[c[0]].cwiseMin(uv_[c[1]]).cwiseMin(uv_[c[2]]) - 1e-9 * step_;
        const Vec2 high = uv_[c[0]].cwiseMax(uv_[c[1]]).cwiseMax(uv_[c[2]]) + 1e-9 * step_;
        for (std::size_t j = column(low[1], 1); j <= column(high[1], 1); ++j) {
            for (std::size_t i = column(low[0], 0); i <= column(high[0], 0); ++i) {
                visit(j * cells_ + i);
            }
        }
    }

    void build() {
        const Box<Vec2> box = box_round(std::span<const Vec2>(uv_));
        low_ = box.low;
        cells_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles_.size()))) + 1;
        step_ = ((box.high - low_) / static_cast<double>(cells_)).cwiseMax(std::numeric_limits<double>::min());
        begin_.assign(cells_ * cells_ + 1, 0);
        for (const TriCorners& c : triangles_) {
            each_cell(c, [&](std::size_t cell) { ++begin_[cell + 1]; });
        }
        for (std::size_t i = 1; i < begin_.size(); ++i) {
            begin_[i] += begin_[i - 1];
        }
        listed_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            each_cell(triangles_[t], [&](std::size_t cell) { listed_[next[cell]++] = static_cast<Index>(t); });
        }
    }

    void improve(Hit& hit, std::size_t t, const Vec2& p) const {
        const Vec2& a = uv_[triangles_[t][0]];
        const Vec2 b = uv_[triangles_[t][1]] - a;
        const Vec2 c = uv_[triangles_[t][2]] - a;
        const double area = b[0] * c[1] - b[1] * c[0];
        if (!(area > 0.0)) {
            return;
        }
        const Vec2 x = p - a;
        const double v = (x[0] * c[1] - x[1] * c[0]) / area;
        const double w = (b[0] * x[1] - b[1] * x[0]) / area;
        const double inside = std::min({1.0 - v - w, v, w});
        if (inside > hit.inside) {
            hit = {t, {1.0 - v - w, v, w}, inside};
        }
    }

    std::vector<Vec2> uv_;
    std::vector<TriCorners> triangles_;
    Vec2 low_ = Vec2::Zero(), step_ = Vec2::Ones();
    std::size_t cells_ = 1;
    std::vector<std::size_t> begin_;  // grid cell -> triangles, flat
    std::vector<Index> listed_;
};

}  // namespace pavior::detail
