#pragma once
/// \file
/// A polyline by arc length.

#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// An open polyline that knows its arc length. Segments of length 0 are allowed, a length of 0 altogether too: then
/// every place is its first point.
class ChainCurve {
public:
    ChainCurve() = default;
    /// \throws InputError size_mismatch for less than two points
    explicit ChainCurve(std::vector<Vec3> points) : points_(std::move(points)) {
        if (points_.size() < 2) {
            throw InputError(ErrorCode::size_mismatch,
                             "a polyline needs two points, not " + std::to_string(points_.size()));
        }
        reach_.reserve(points_.size());
        reach_.push_back(0.0);
        for (std::size_t i = 1; i < points_.size(); ++i) {
            reach_.push_back(reach_.back() + (points_[i] - points_[i - 1]).norm());
        }
    }

    [[nodiscard]] std::span<const Vec3> points() const { return points_; }
    [[nodiscard]] double length() const { return reach_.empty() ? 0.0 : reach_.back(); }

    /// Where point \p i lies: the fraction of the length before it. Equally spaced points if the length is 0.
    [[nodiscard]] double fraction(std::size_t i) const {
        return length() > 0.0 ? reach_[i] / length() : static_cast<double>(i) / static_cast<double>(reach_.size() - 1);
    }

    /// The point at the fraction \p t of the length, clamped to [0, 1]; the ends are exact. O(log n).
    [[nodiscard]] Vec3 at(double t) const {
        if (!(t > 0.0) || !(length() > 0.0)) {
            return points_.front();
        }
        if (t >= 1.0) {
            return points_.back();
        }
        const double wanted = t * length();
        const auto above = std::upper_bound(reach_.begin() + 1, reach_.end() - 1, wanted);
        const auto i = static_cast<std::size_t>(above - reach_.begin());
        const double step = reach_[i] - reach_[i - 1];
        const double s = step > 0.0 ? std::clamp((wanted - reach_[i - 1]) / step, 0.0, 1.0) : 0.0;
        return (1.0 - s) * points_[i - 1] + s * points_[i];
    }

    /// Largest distance of a point from the straight line between the ends (from the first point if they coincide).
    [[nodiscard]] double sag() const {
        double largest = 0.0;
        for (const Vec3& p : points_) {
            const Vec3 axis = points_.back() - points_.front();
            const double square = axis.squaredNorm();
            const double s = square > 0.0 ? (p - points_.front()).dot(axis) / square : 0.0;
            largest = std::max(largest, (p - points_.front() - s * axis).norm());
        }
        return largest;
    }

private:
    std::vector<Vec3> points_;
    std::vector<double> reach_;  // arc length from the first point to each
};

}  // namespace pavior
