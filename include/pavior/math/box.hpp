#pragma once
/// \file
/// Axis-parallel boxes round points.

#include <pavior/math/point.hpp>

#include <limits>
#include <span>

namespace pavior {

/// The smallest box round the points added to it (P: Vec2 or Vec3); empty, with low > high, until there is one. Points
/// should be finite.
template <class P = Vec3>
struct Box {
    P low = P::Constant(std::numeric_limits<double>::infinity());
    P high = P::Constant(-std::numeric_limits<double>::infinity());

    void add(const P& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    void add(const Box& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    [[nodiscard]] bool empty() const { return !(low[0] <= high[0]); }
    [[nodiscard]] P extent() const { return empty() ? P(P::Zero()) : P(high - low); }
    /// Does not overflow where the squares of coordinates do.
    [[nodiscard]] double diagonal() const { return extent().stableNorm(); }
    [[nodiscard]] P centre() const { return empty() ? P(P::Zero()) : P(low + (high - low) / 2.0); }
    /// The squared distance of \p p, 0 inside; infinite for an empty box.
    [[nodiscard]] double square_distance(const P& p) const {
        return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
    }
};

/// The box round \p points. O(n).
template <class P>
[[nodiscard]] Box<P> box_round(std::span<const P> points) {
    Box<P> box;
    for (const P& p : points) {
        box.add(p);
    }
    return box;
}

}  // namespace pavior
