#pragma once

#include <pavior/core/error.hpp>
#include <pavior/lattice/submap_corners.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<CornerClass> corner_classes(double angle, const CornerOptions& options) {
    std::vector<CornerClass> result;
    for (const CornerClass c : {CornerClass::end, CornerClass::side, CornerClass::corner, CornerClass::reversal}) {
        if (std::abs(corner_deviation(angle, c)) <= options.max_deviation + 1e-9 &&
            (options.reversals || c != CornerClass::reversal)) {
            result.push_back(c);
        }
    }
    return result;
}

PAVIOR_INLINE std::optional<LoopClasses> classify_loop(std::span<const double> angles, int turning,
                                                       const CornerOptions& options) {
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
