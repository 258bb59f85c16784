#pragma once
/// \file
/// Coordinates along a curve in space, in which what was swept along it is straight.

#include <pavior/core/assert.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// A smooth curve c with unit tangent t and a frame (e1, e2, t) that does not turn about t, and the coordinates
/// (u, v, height) of the point c + u e1 + v e2: a right-handed system. The curve is cubic between samples, its frames
/// are made by double reflection \cite wang2008; beyond its ends it goes on straight. Height is the arc length from the
/// first sample, or more where the curve turns sharply. The coordinates are one to one where a point is nearer to one
/// place of the curve than to all others, and there nearer than the centre of curvature (`stretch() > 0`).
class Spine {
public:
    /// Height grows by at least \p per_radian for each radian that the curve turns.
    explicit Spine(double per_radian = 0.0) : per_radian_(per_radian) {}

    /// Goes on through \p points, no two neighbours equal, where the curve has the unit \p tangents: at least two the
    /// first time. Later the first of them must have the tangent of the end and lie in its normal plane; all are moved
    /// in parallel so that it becomes the end. O(points).
    void append(std::span<const Vec3> points, std::span<const Vec3> tangents) {
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

    [[nodiscard]] double height() const { return samples_.back().height; }

    [[nodiscard]] Vec3 unrolled(const Vec3& p) const {
        const Place at = foot(p);
        return {(p - at.point).dot(at.side), (p - at.point).dot(at.other()), at.height};
    }
    [[nodiscard]] Vec3 rolled(const Vec3& q) const {
        const Place at = place(q[2]);
        return at.point + q[0] * at.side + q[1] * at.other();
    }
    /// The image of a direction \p d at \p p.
    [[nodiscard]] Vec3 unrolled(const Vec3& p, const Vec3& d) const {
        const Place at = foot(p);
        return {d.dot(at.side), d.dot(at.other()), d.dot(at.tangent) / (at.rate * at.stretch(p))};
    }
    /// Length at \p p of what is as long as 1 on the curve; not positive where the coordinates are of no use.
    [[nodiscard]] double stretch(const Vec3& p) const { return foot(p).stretch(p); }

    /// The parallel curve through the points (u, v, height).
    [[nodiscard]] Spine parallel(double u, double v) const {
        Spine result(per_radian_);
        for (const Sample& s : samples_) {
            result.push(s.point + u * s.side + v * s.tangent.cross(s.side), s.tangent, s.side);
        }
        return result;
    }

private:
    struct Sample {
        Vec3 point, tangent, side;
        double length;  ///< from the sample before
        double height;
    };
    struct Place {
        Vec3 point, tangent, side;
        Vec3 curvature = Vec3::Zero();  ///< towards the centre, 1 / radius
        double height = 0.0;
        double rate = 1.0;  ///< length by height

        [[nodiscard]] Vec3 other() const { return tangent.cross(side); }
        [[nodiscard]] double stretch(const Vec3& p) const { return 1.0 - curvature.dot(p - point); }
    };
    struct Curve {
        Vec3 point, slope, bend;  ///< c, c' and c'' by the parameter 0 .. 1 of a segment
    };

    void push(const Vec3& point, const Vec3& tangent, const Vec3& side) {
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

    [[nodiscard]] static Vec3 transported(const Vec3& side, const Vec3& p, const Vec3& t, const Vec3& q,
                                          const Vec3& tq) {
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

    /// Cubic of the segment from sample i to the next.
    [[nodiscard]] Curve curve(std::size_t i, double x) const {
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

    /// Of segment \p i at 0 <= x <= 1.
    [[nodiscard]] Place place(std::size_t i, double x) const {
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

    /// On the straight line through a sample, \p length along it.
    [[nodiscard]] static Place beyond(const Sample& s, double length) {
        return {s.point + length * s.tangent, s.tangent, s.side, Vec3::Zero(), s.height + length, 1.0};
    }

    [[nodiscard]] Place place(double height) const {
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

    /// Length from sample i to the normal plane that holds \p p, along the tangent.
    [[nodiscard]] double ahead(std::size_t i, const Vec3& p) const {
        return (p - samples_[i].point).dot(samples_[i].tangent);
    }

    /// Where the normal plane holds \p p, of such places one next to the nearest sample.
    [[nodiscard]] Place foot(const Vec3& p) const {
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

    /// The zero of (p - c) . t in segment i, by the Illinois method: it is \p low >= 0 at 0 and \p high < 0 at 1.
    [[nodiscard]] double foot_in(std::size_t i, const Vec3& p, double low, double high) const {
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

    std::vector<Sample> samples_;
    double per_radian_;
};

}  // namespace pavior
