#pragma once

#include <pavior/block/chain_curve.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE ChainCurve::ChainCurve(std::vector<Vec3> points) : points_(std::move(points)) {
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

PAVIOR_INLINE Vec3 ChainCurve::at(double t) const {
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

PAVIOR_INLINE double ChainCurve::sag() const {
    double largest = 0.0;
    for (const Vec3& p : points_) {
        const Vec3 axis = points_.back() - points_.front();
        const double square = axis.squaredNorm();
        const double s = square > 0.0 ? (p - points_.front()).dot(axis) / square : 0.0;
        largest = std::max(largest, (p - points_.front() - s * axis).norm());
    }
    return largest;
}

}  // namespace pavior
