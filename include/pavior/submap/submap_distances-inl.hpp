#pragma once

#include <pavior/submap/submap_distances.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE bool SideOutline::contains(const Vec2& p) const {
    bool inside = false;
    for (const std::vector<Vec2>& loop : loops) {
        inside = inside != inside_polygon(p, loop);
    }
    return inside;
}

PAVIOR_INLINE bool SideOutline::meets(const SideOutline& other, double margin) const {
    const Vec2 from = low.cwiseMax(other.low), to = high.cwiseMin(other.high);
    const double tiny = 1e-6 * (high - low + other.high - other.low).maxCoeff();
    if (margin > 0.0) {
        return (to - from).minCoeff() > -margin;
    }
    if ((to - from).minCoeff() <= tiny) {
        return false;
    }
    std::array<std::vector<double>, 2> middles;
    for (std::size_t a = 0; a < 2; ++a) {
        std::vector<double> all;
        std::set_union(cuts[a].begin(), cuts[a].end(), other.cuts[a].begin(), other.cuts[a].end(),
                       std::back_inserter(all));
        for (std::size_t i = 0; i + 1 < all.size(); ++i) {
            if (all[i + 1] - all[i] > tiny) {
                middles[a].push_back(0.5 * (all[i] + all[i + 1]));
            }
        }
    }
    for (const double x : middles[0]) {
        for (const double y : middles[1]) {
            if (contains({x, y}) && other.contains({x, y})) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace detail

}  // namespace pavior
