#pragma once

#include <pavior/contributions/dual_blocks.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace pavior {

namespace detail {

PAVIOR_INLINE void PairCollector::add(Index a, Index b) {
    std::array<Index, 2>& recent = recent_[(a * 31U + b) % recent_.size()];
    const std::array<Index, 2> pair{std::min(a, b), std::max(a, b)};
    if (recent != pair) {
        recent = pair;
        pairs_.push_back(pair);
        if (pairs_.size() > limit_) {
            compact();
            limit_ = std::max<std::size_t>(4096, 2 * pairs_.size());
        }
    }
}

}  // namespace detail

}  // namespace pavior
