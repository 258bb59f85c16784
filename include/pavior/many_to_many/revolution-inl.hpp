#pragma once

#include <pavior/many_to_many/revolution.hpp>

#include <cmath>

namespace pavior {

PAVIOR_INLINE Vec3 Unrolling::unrolled(const Vec3& p) const {
    const Vec3 d = p - axis_.origin;
    const double x = d.dot(x_);
    const double y = d.dot(y_);
    return {std::hypot(x, y), radius_ * std::atan2(y, x), d.dot(axis_.direction)};
}

PAVIOR_INLINE Vec3 Unrolling::unrolled(const Vec3& p, const Vec3& d) const {
    const Vec3 offset = p - axis_.origin;
    const Vec3 radial = offset.dot(x_) * x_ + offset.dot(y_) * y_;
    const double r = radial.norm();
    return {d.dot(radial) / r, d.dot(axis_.direction.cross(radial)) * radius_ / (r * r), d.dot(axis_.direction)};
}

}  // namespace pavior
