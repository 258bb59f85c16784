#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/many_to_many/spine.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pavior {

PAVIOR_INLINE void Spine::append(std::span<const Vec3> points, std::span<const Vec3> tangents) {
    PAVIOR_ASSERT(points.size() >= 2 && tangents.size() == points.size());
    if (samples_.empty()) {
        push(points[0], tangents[0], tangents[0].unitOrthogonal());
    }
    Vec3 side = samples_.back().side;
    const Vec3 aside = samples_.back().point - points[0];
    const double u = aside.dot(side);
    const double v = aside.dot(tangents[0].cross(side));
    for (std::size_t i = 1; i < points.size(); ++i) {
        side = transported(side, points[i - 1], tangents[i - 1], points[i], tangents[i]);
        push(points[i] + u * side + v * tangents[i].cross(side), tangents[i], side);
    }
}

PAVIOR_INLINE Spine Spine::parallel(double u, double v) const {
    Spine result(per_radian_);
    for (const Sample& s : samples_) {
        result.push(s.point + u * s.side + v * s.tangent.cross(s.side), s.tangent, s.side);
    }
    return result;
}

PAVIOR_INLINE void Spine::push(const Vec3& point, const Vec3& tangent, const Vec3& side) {
    if (samples_.empty()) {
        samples_.push_back({point, tangent, side, 0.0, 0.0});
        return;
    }
    const Sample& last = samples_.back();
    const double turn = std::atan2(last.tangent.cross(tangent).norm(), last.tangent.dot(tangent));
    const double chord = (point - last.point).norm();
    const double length = turn > 1e-8 ? chord * 0.5 * turn / std::sin(0.5 * turn) : chord;
    samples_.push_back({point, tangent, side, length, last.height + std::max(length, per_radian_ * turn)});
}

PAVIOR_INLINE Vec3 Spine::transported(const Vec3& side, const Vec3& p, const Vec3& t, const Vec3& q, const Vec3& tq) {
    const Vec3 step = q - p;
    const double square = step.squaredNorm();
    if (!(square > 0.0)) {
        return (side - side.dot(tq) * tq).normalized();
    }
    const Vec3 mirrored = side - (2.0 / square) * step.dot(side) * step;
    const Vec3 between = tq - (t - (2.0 / square) * step.dot(t) * step);
    const Vec3 result = mirrored - (2.0 / between.squaredNorm()) * between.dot(mirrored) * between;
    return (result - result.dot(tq) * tq).normalized();
}

PAVIOR_INLINE Spine::Curve Spine::curve(std::size_t i, double x) const {
    const Sample& a = samples_[i];
    const Sample& b = samples_[i + 1];
    const Vec3 m = b.length * a.tangent;
    const Vec3 n = b.length * b.tangent;
    const Vec3 d = b.point - a.point;
    const Vec3 two = 3.0 * d - 2.0 * m - n;
    const Vec3 three = m + n - 2.0 * d;
    return {a.point + x * (m + x * (two + x * three)), m + x * (2.0 * two + 3.0 * x * three),
            2.0 * two + 6.0 * x * three};
}

PAVIOR_INLINE Spine::Place Spine::place(std::size_t i, double x) const {
    const Curve c = curve(i, x);
    const double rise = samples_[i + 1].height - samples_[i].height;
    const double speed = c.slope.norm();
    Place at;
    at.point = c.point;
    at.tangent = c.slope / speed;
    at.side = transported(samples_[i].side, samples_[i].point, samples_[i].tangent, at.point, at.tangent);
    at.curvature = (c.bend - c.bend.dot(at.tangent) * at.tangent) / (speed * speed);
    at.height = samples_[i].height + x * rise;
    at.rate = speed / rise;
    return at;
}

PAVIOR_INLINE Spine::Place Spine::place(double height) const {
    if (height <= 0.0) {
        return beyond(samples_.front(), height);
    }
    if (height >= samples_.back().height) {
        return beyond(samples_.back(), height - samples_.back().height);
    }
    const auto above = std::upper_bound(samples_.begin(), samples_.end(), height,
                                        [](double h, const Sample& s) { return h < s.height; });
    const auto i = static_cast<std::size_t>(above - samples_.begin()) - 1;
    return place(i, (height - samples_[i].height) / (samples_[i + 1].height - samples_[i].height));
}

PAVIOR_INLINE Spine::Place Spine::foot(const Vec3& p) const {
    std::size_t i = 0;
    double least = (p - samples_[0].point).squaredNorm();
    for (std::size_t k = 1; k < samples_.size(); ++k) {
        const double square = (p - samples_[k].point).squaredNorm();
        if (square < least) {
            least = square;
            i = k;
        }
    }
    while (i > 0 && ahead(i, p) < 0.0) {
        --i;
    }
    while (i + 1 < samples_.size() && ahead(i + 1, p) >= 0.0) {
        ++i;
    }
    const double first = ahead(i, p);
    if (first < 0.0 || i + 1 == samples_.size()) {
        return beyond(samples_[i], first);
    }
    return place(i, foot_in(i, p, first, ahead(i + 1, p)));
}

PAVIOR_INLINE double Spine::foot_in(std::size_t i, const Vec3& p, double low, double high) const {
    constexpr int most = 60;
    double a = 0.0;
    double b = 1.0;
    double x = 0.0;
    const double enough = 1e-15 * (low - high);
    for (int k = low > enough ? 0 : most, side = 0; k < most; ++k) {
        x = (a * high - b * low) / (high - low);
        const Curve c = curve(i, x);
        const double value = (p - c.point).dot(c.slope) / c.slope.norm();
        if (std::abs(value) <= enough || b - a < 1e-16) {
            break;
        }
        if (value > 0.0) {
            a = x;
            low = value;
            high *= side == 1 ? 0.5 : 1.0;
            side = 1;
        } else {
            b = x;
            high = value;
            low *= side == -1 ? 0.5 : 1.0;
            side = -1;
        }
    }
    return x;
}

}  // namespace pavior
