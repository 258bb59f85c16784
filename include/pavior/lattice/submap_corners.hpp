#pragma once
/// \file
/// Classes of the corners of a loop for submapping: how many quads meet there.

#include <pavior/core/compiled.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// Class of a corner of a face: the number of quads that meet there, so an interior angle of about 90 degrees times
/// the value.
enum class CornerClass : std::uint8_t { end = 1, side = 2, corner = 3, reversal = 4 };

/// Quarter turns to the left that the boundary makes at a corner of class \p c: 1, 0, -1, -2.
[[nodiscard]] constexpr int quarter_turns(CornerClass c) { return 2 - static_cast<int>(c); }

struct CornerOptions {
    /// Largest difference between an interior angle and the angle of its class, degrees, in (0, 90].
    double max_deviation = 60.0;
    /// Admit the class `reversal`. Both edges of a reversal lie on the same lattice line, which the meshes of this
    /// library cannot hold, so they leave it out.
    bool reversals = false;
};

/// Interior angle minus that of the class, degrees.
[[nodiscard]] constexpr double corner_deviation(double angle, CornerClass c) {
    return angle - 90.0 * static_cast<double>(c);
}

/// What class \p c costs at a corner of \p angle degrees: the square of the deviation in right angles.
[[nodiscard]] constexpr double corner_cost(double angle, CornerClass c) {
    const double deviation = corner_deviation(angle, c) / 90.0;
    return deviation * deviation;
}

/// The classes that an angle admits, in ascending order; at least one for every angle in [30, 330] with the defaults.
[[nodiscard]] PAVIOR_INLINE std::vector<CornerClass> corner_classes(double angle, const CornerOptions& options = {});

/// The classes of one loop.
struct LoopClasses {
    std::vector<CornerClass> classes;  ///< one a corner
    double cost = 0.0;                 ///< sum of corner_cost()
};

/// Classes of least total cost among those whose quarter turns sum up to \p turning: 4 for an outer loop, -4 for the
/// loop of a hole. The loop is judged as a whole: a corner of 130 degrees becomes an end or a side as the others need
/// it. Exact (dynamic programming over the partial sums). Nothing if an angle admits no class or no choice sums up.
/// \param angles interior angles in degrees, in the order of the loop
/// O(n s) for s different partial sums. \throws InputError bad_option for a max_deviation outside (0, 90], not_finite
[[nodiscard]] PAVIOR_INLINE std::optional<LoopClasses> classify_loop(std::span<const double> angles, int turning,
                                                                     const CornerOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/submap_corners-inl.hpp>
#endif
