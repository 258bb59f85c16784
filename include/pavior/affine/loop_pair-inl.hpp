#pragma once

#include <pavior/affine/loop_pair.hpp>
#include <pavior/core/error.hpp>

#include <string>

namespace pavior::detail {

PAVIOR_INLINE void check_pair(Eigen::Index n, Eigen::Index m, Eigen::Index target_n, Eigen::Index target_m) {
    if (m == 0 || n < 2) {
        throw InputError(ErrorCode::empty_input, "affine fit: no points, or points with less than two coordinates");
    }
    if (m != target_m || n != target_n) {
        throw InputError(ErrorCode::size_mismatch, "affine fit: source of " + std::to_string(m) +
                                                       " points, target of " + std::to_string(target_m));
    }
}

}  // namespace pavior::detail
