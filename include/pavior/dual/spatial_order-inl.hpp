#pragma once

#include <pavior/dual/spatial_order.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void radix_pass(std::vector<std::pair<std::uint64_t, Index>>& keys,
                              std::vector<std::pair<std::uint64_t, Index>>& other, unsigned shift) {
    std::vector<std::size_t> start(2049, 0);
    for (const auto& key : keys) {
        ++start[(key.first >> shift & 2047U) + 1];
    }
    for (std::size_t i = 1; i < start.size(); ++i) {
        start[i] += start[i - 1];
    }
    for (const auto& key : keys) {
        other[start[key.first >> shift & 2047U]++] = key;
    }
    keys.swap(other);
}

}  // namespace detail

}  // namespace pavior
