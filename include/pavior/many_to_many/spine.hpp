#pragma once
/// \file
/// Coordinates along a curve in space, in which what was swept along it is straight.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

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
    void append(std::span<const Vec3> points, std::span<const Vec3> tangents);

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
    [[nodiscard]] Spine parallel(double u, double v) const;

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

    void push(const Vec3& point, const Vec3& tangent, const Vec3& side);

    [[nodiscard]] static Vec3 transported(const Vec3& side, const Vec3& p, const Vec3& t, const Vec3& q,
                                          const Vec3& tq);

    /// Cubic of the segment from sample i to the next.
    [[nodiscard]] Curve curve(std::size_t i, double x) const;

    /// Of segment \p i at 0 <= x <= 1.
    [[nodiscard]] Place place(std::size_t i, double x) const;

    /// On the straight line through a sample, \p length along it.
    [[nodiscard]] static Place beyond(const Sample& s, double length) {
        return {s.point + length * s.tangent, s.tangent, s.side, Vec3::Zero(), s.height + length, 1.0};
    }

    [[nodiscard]] Place place(double height) const;

    /// Length from sample i to the normal plane that holds \p p, along the tangent.
    [[nodiscard]] double ahead(std::size_t i, const Vec3& p) const {
        return (p - samples_[i].point).dot(samples_[i].tangent);
    }

    /// Where the normal plane holds \p p, of such places one next to the nearest sample.
    [[nodiscard]] Place foot(const Vec3& p) const;

    /// The zero of (p - c) . t in segment i, by the Illinois method: it is \p low >= 0 at 0 and \p high < 0 at 1.
    [[nodiscard]] double foot_in(std::size_t i, const Vec3& p, double low, double high) const;

    std::vector<Sample> samples_;
    double per_radian_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/spine-inl.hpp>
#endif
