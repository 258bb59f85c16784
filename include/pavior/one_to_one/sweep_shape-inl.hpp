#pragma once

#include <pavior/one_to_one/sweep_shape.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pavior {

PAVIOR_INLINE bool better_sweep(const SweepTopology& a, const SweepTopology& b) {
    const auto rank = [](const SweepTopology& s) {
        const auto steps = [](double value, double step) { return std::floor(value / step + 1e-6); };
        return std::tuple(s.stacked, steps(std::max(s.shape.corner_deviation, s.shape.cap_deviation), 15.0),
                          -static_cast<double>(s.shape.cap_loops), -static_cast<double>(s.shape.cap_edges),
                          steps(std::log2(std::min(s.shape.rib_ratio, 1e9)), 0.25), steps(s.shape.rib_turn, 15.0),
                          steps(s.shape.cap_warp, 15.0), s.source, s.target);
    };
    return rank(a) < rank(b);
}

}  // namespace pavior
