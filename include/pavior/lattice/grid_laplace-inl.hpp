#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/lattice/grid_laplace.hpp>

#include <algorithm>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<int> every_second(const std::vector<int>& kept, const std::vector<int>& key) {
    std::vector<int> result;
    bool skip = false;
    for (const int plane : kept) {
        const bool is_key = std::binary_search(key.begin(), key.end(), plane);
        if (is_key || !skip) {
            result.push_back(plane);
            skip = true;
        } else {
            skip = false;
        }
    }
    return result;
}

}  // namespace detail

}  // namespace pavior
