#pragma once

#include <pavior/affine/pseudo_area.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace pavior {

PAVIOR_INLINE void verify_loop_offsets(std::span<const std::size_t> offsets, std::size_t m) {
    if (offsets.size() < 2 || offsets.front() != 0 || offsets.back() != m ||
        !std::is_sorted(offsets.begin(), offsets.end())) {
        throw InputError(ErrorCode::bad_index, "loop offsets do not run from 0 to the number of points");
    }
}

}  // namespace pavior
