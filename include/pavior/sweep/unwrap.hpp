#pragma once
/// \file
/// Parameters on periodic surfaces: chains and loops that continue across the seam.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace pavior {

/// Periods of a surface in u and v, 0 where it is not periodic.
using Periods = std::array<double, 2>;

/// The whole number of periods to add to \p p so that it comes next to \p near. A point that is half a period away
/// (within 1e-9 of it) stays. O(1).
[[nodiscard]] PAVIOR_INLINE Vec2 nearest_image_shift(const Vec2& p, const Vec2& near, const Periods& periods);

/// Makes a chain continuous: each node is moved by whole periods next to the one before. Steps of up to half a period
/// are taken as they are, so a chain whose true steps are longer cannot be recognised. O(n).
inline void unwrap_chain(std::span<Vec2> chain, const Periods& periods) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
        chain[i] += nearest_image_shift(chain[i], chain[i - 1], periods);
    }
}

/// Whether a loop closes in the parameter plane.
struct UnwrapReport {
    bool closed = true;       ///< the largest gap is below the tolerance
    Vec2 gap = Vec2::Zero();  ///< the largest jump between consecutive chains, the last and the first included
};

/// Moves whole chains by periods so that they run head to tail around a closed loop: chain c + 1 starts where chain c
/// ends (both hold the common node). Each chain must be continuous in itself (unwrap_chain); the first stays.
/// Not closed if a jump larger than \p tolerance (unit of the parameters) remains: the loop winds around the surface
/// (gap of a whole period), meets a pole, or is no loop. Empty chains are skipped. O(n).
PAVIOR_INLINE UnwrapReport unwrap_loop(std::span<const std::span<Vec2>> chains, const Periods& periods,
                                       double tolerance);

/// The same for the four sides of a grid (as GridSides: bottom and top run with i, left and right with k); bottom
/// stays.
PAVIOR_INLINE UnwrapReport unwrap_sides(std::span<Vec2> bottom, std::span<Vec2> top, std::span<Vec2> left,
                                        std::span<Vec2> right, const Periods& periods, double tolerance);

/// Is \p p inside the closed polygon (even-odd rule)? Points on the polygon may go either way. O(n).
[[nodiscard]] PAVIOR_INLINE bool inside_polygon(const Vec2& p, std::span<const Vec2> polygon);

/// The whole periods to add to \p p so that it lies inside the unwrapped outer loop \p polygon; for inner nodes and for
/// the first node of a hole. If no image lies inside, the one next to the middle of the polygon's box. O(n).
[[nodiscard]] PAVIOR_INLINE Vec2 inside_shift(const Vec2& p, std::span<const Vec2> polygon, const Periods& periods);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/unwrap-inl.hpp>
#endif
