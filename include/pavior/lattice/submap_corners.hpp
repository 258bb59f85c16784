#pragma once
/// \file
/// Classes of the corners of a loop for submapping: how many quads meet there.

#include <pavior/core/error.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
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
[[nodiscard]] inline std::vector<CornerClass> corner_classes(double angle, const CornerOptions& options = {}) {
    std::vector<CornerClass> result;
    for (const CornerClass c : {CornerClass::end, CornerClass::side, CornerClass::corner, CornerClass::reversal}) {
        if (std::abs(corner_deviation(angle, c)) <= options.max_deviation + 1e-9 &&
            (options.reversals || c != CornerClass::reversal)) {
            result.push_back(c);
        }
    }
    return result;
}

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
[[nodiscard]] inline std::optional<LoopClasses> classify_loop(std::span<const double> angles, int turning,
                                                              const CornerOptions& options = {}) {
    if (!(options.max_deviation > 0.0 && options.max_deviation <= 90.0)) {
        throw InputError(ErrorCode::bad_option, "the largest deviation of a corner must lie in (0, 90] degrees");
    }
    constexpr double never = std::numeric_limits<double>::infinity();
    struct Stage {
        int low = 0;                     ///< the partial sum of entry 0
        std::vector<double> cost;        ///< per partial sum
        std::vector<CornerClass> taken;  ///< class of the last corner
    };
    std::vector<Stage> stages{{0, {0.0}, {CornerClass::side}}};
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!std::isfinite(angles[i])) {
            throw InputError(ErrorCode::not_finite, "corner " + std::to_string(i) + " has no angle",
                             {static_cast<std::int64_t>(i)});
        }
        const std::vector<CornerClass> allowed = corner_classes(angles[i], options);
        if (allowed.empty()) {
            return std::nullopt;
        }
        const int least = quarter_turns(allowed.back()), most = quarter_turns(allowed.front());
        const Stage& last = stages.back();
        const std::size_t count = last.cost.size() + static_cast<std::size_t>(most - least);
        Stage next{last.low + least, std::vector<double>(count, never), std::vector<CornerClass>(count)};
        for (std::size_t s = 0; s < last.cost.size(); ++s) {
            for (const CornerClass c : allowed) {
                const std::size_t at = s + static_cast<std::size_t>(quarter_turns(c) - least);
                const double cost = last.cost[s] + corner_cost(angles[i], c);
                if (cost < next.cost[at]) {
                    next.cost[at] = cost;
                    next.taken[at] = c;
                }
            }
        }
        stages.push_back(std::move(next));
    }
    int sum = turning;
    const auto reachable = [&](const Stage& stage, int at) {
        return at >= stage.low && at - stage.low < static_cast<int>(stage.cost.size());
    };
    if (!reachable(stages.back(), sum) ||
        std::isinf(stages.back().cost[static_cast<std::size_t>(sum - stages.back().low)])) {
        return std::nullopt;
    }
    LoopClasses result{std::vector<CornerClass>(angles.size()),
                       stages.back().cost[static_cast<std::size_t>(sum - stages.back().low)]};
    for (std::size_t i = angles.size(); i-- > 0;) {
        const Stage& stage = stages[i + 1];
        result.classes[i] = stage.taken[static_cast<std::size_t>(sum - stage.low)];
        sum -= quarter_turns(result.classes[i]);
    }
    return result;
}

}  // namespace pavior
