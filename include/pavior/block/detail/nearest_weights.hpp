#pragma once
/// \file
/// The point of a triangle nearest to another point.

#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace pavior::detail {

/// Weights of the corners of triangle \p a \p b \p c, none negative, of sum 1, that make its point nearest to \p x.
[[nodiscard]] inline Eigen::Vector3d nearest_weights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 n = ab.cross(ac);
    const double square = n.squaredNorm();
    if (square > 0.0) {
        const double v = (x - a).cross(ac).dot(n) / square;
        const double w = ab.cross(x - a).dot(n) / square;
        if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
            return {1.0 - v - w, v, w};
        }
    }
    Eigen::Vector3d best(1, 0, 0);
    double distance = std::numeric_limits<double>::infinity();
    const std::array<const Vec3*, 3> p{&a, &b, &c};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 axis = *p[(k + 1) % 3] - *p[k];
        const double length = axis.squaredNorm();
        const double t = length > 0.0 ? std::clamp((x - *p[k]).dot(axis) / length, 0.0, 1.0) : 0.0;
        const double d = (*p[k] + t * axis - x).squaredNorm();
        if (d < distance) {
            distance = d;
            best = Eigen::Vector3d::Zero();
            best[static_cast<Eigen::Index>(k)] = 1.0 - t;
            best[static_cast<Eigen::Index>((k + 1) % 3)] = t;
        }
    }
    return best;
}

}  // namespace pavior::detail
