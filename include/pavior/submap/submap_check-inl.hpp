#pragma once

#include <pavior/submap/submap_check.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::set<std::size_t> contested(std::vector<LatticeClaim> claims) {
    std::set<std::size_t> result;
    std::sort(claims.begin(), claims.end());
    for (std::size_t i = 1; i < claims.size(); ++i) {
        const LatticeClaim &a = claims[i - 1], &c = claims[i];
        if (a.point == c.point && (a.dimension != c.dimension || a.entity != c.entity)) {
            result.insert({a.side, c.side});
        }
    }
    return result;
}

}  // namespace detail

}  // namespace pavior
