#pragma once

#include <pavior/mesh/edge_table.hpp>

#include <algorithm>
#include <cstddef>

namespace pavior {

PAVIOR_INLINE void EdgeTable::sort() {
    for (std::size_t low = 0; low + 1 < ends_.size(); ++low) {
        std::sort(uses_.begin() + static_cast<std::ptrdiff_t>(begin_of(low)),
                  uses_.begin() + static_cast<std::ptrdiff_t>(ends_[low]));
    }
}

}  // namespace pavior
