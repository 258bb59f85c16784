#pragma once

#include <pavior/many_to_many/extrusion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE ExtrusionRole role_of(std::span<const Vec3> normals, const Vec3& direction,
                                    const ExtrusionOptions& options, ExtrusionRefusal& refusal) {
    constexpr double degrees = 57.29577951308232;
    double low = 1;
    double high = -1;
    for (const Vec3& n : normals) {
        low = std::min(low, n.dot(direction));
        high = std::max(high, n.dot(direction));
    }
    refusal.low = degrees * std::acos(std::clamp(high, -1.0, 1.0));
    refusal.high = degrees * std::acos(std::clamp(low, -1.0, 1.0));
    if (normals.empty()) {
        return ExtrusionRole::none;
    }
    if (std::max(std::abs(low), std::abs(high)) <= options.side_tolerance) {
        return ExtrusionRole::side;
    }
    if (low > 1 - 1e-10 || high < -1 + 1e-10) {
        return ExtrusionRole::flat;
    }
    const double least = std::cos(options.max_slope / degrees);
    return low >= least || high <= -least ? ExtrusionRole::cap : ExtrusionRole::none;
}

PAVIOR_INLINE void add_direction(std::vector<Vec3>& directions, Vec3 d) {
    if (!(d.norm() > 0)) {
        return;
    }
    d.normalize();
    for (int k = 0; k < 3; ++k) {
        if (std::abs(std::abs(d[k]) - 1) < 1e-12) {
            d = Vec3::Unit(k);
        }
    }
    for (int k = 2; k >= 0; --k) {  // towards the positive half space
        if (std::abs(d[k]) > 1e-9) {
            d = d[k] < 0 ? Vec3(-d) : d;
            break;
        }
    }
    if (std::none_of(directions.begin(), directions.end(), [&](const Vec3& e) { return e.cross(d).norm() < 1e-6; })) {
        directions.push_back(d);
    }
}

}  // namespace detail

}  // namespace pavior
