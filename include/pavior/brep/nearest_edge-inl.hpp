#pragma once

#include <pavior/brep/nearest_edge.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE EdgeSamples::Foot EdgeSamples::nearest(const Vec3& x) const {
    Foot best{0.0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec3 along = points[i + 1] - points[i];
        const double square = along.squaredNorm();
        const double part = square > 0 ? std::clamp((x - points[i]).dot(along) / square, 0.0, 1.0) : 0.0;
        const double distance = (points[i] + part * along - x).squaredNorm();
        if (distance < best.distance) {
            best = {static_cast<double>(i) + part, distance};
        }
    }
    best.distance = std::sqrt(best.distance);
    return best;
}

PAVIOR_INLINE void EdgeSamples::refine(std::span<const Vec3> middles) {
    std::vector<Vec3> finer;
    slack = 0;
    for (std::size_t i = 0; i < middles.size(); ++i) {
        EdgeSamples chord;
        chord.points = {points[i], points[i + 1]};
        slack = std::max(slack, chord.nearest(middles[i]).distance);
        finer.push_back(points[i]);
        finer.push_back(middles[i]);
    }
    finer.push_back(points.back());
    points = std::move(finer);
}

PAVIOR_INLINE bool EdgeSamples::fine(double length) const {
    double longest = 0;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double chord = (points[i + 1] - points[i]).norm();
        longest = std::max(longest, chord);
        sum += chord;
    }
    return points.size() > 1000 || (slack <= 0.2 * longest && sum >= 0.98 * length);
}

}  // namespace pavior::detail
