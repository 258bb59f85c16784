#pragma once
/// \file
/// A polyline by arc length.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// An open polyline that knows its arc length. Segments of length 0 are allowed, a length of 0 altogether too: then
/// every place is its first point.
class ChainCurve {
public:
    ChainCurve() = default;
    /// \throws InputError size_mismatch for less than two points
    explicit ChainCurve(std::vector<Vec3> points);

    [[nodiscard]] std::span<const Vec3> points() const { return points_; }
    [[nodiscard]] double length() const { return reach_.empty() ? 0.0 : reach_.back(); }

    /// Where point \p i lies: the fraction of the length before it. Equally spaced points if the length is 0.
    [[nodiscard]] double fraction(std::size_t i) const {
        return length() > 0.0 ? reach_[i] / length() : static_cast<double>(i) / static_cast<double>(reach_.size() - 1);
    }

    /// The point at the fraction \p t of the length, clamped to [0, 1]; the ends are exact. O(log n).
    [[nodiscard]] Vec3 at(double t) const;

    /// Largest distance of a point from the straight line between the ends (from the first point if they coincide).
    [[nodiscard]] double sag() const;

private:
    std::vector<Vec3> points_;
    std::vector<double> reach_;  // arc length from the first point to each
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/chain_curve-inl.hpp>
#endif
