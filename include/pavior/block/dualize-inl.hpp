#pragma once

#include <pavior/block/dualize.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pavior {

namespace detail {

PAVIOR_INLINE void require_regular(const CellCorner& corner) {
    bool complete = corner.regular() && corner.vertex != no_index && corner.cell != no_index;
    for (std::size_t k = 0; k < 3; ++k) {
        complete = complete && corner.chains[k] != no_index && corner.patches[k] != no_index;
    }
    if (!complete) {
        throw InputError(ErrorCode::invalid_dual,
                         "a corner of cell " + std::to_string(corner.cell) + " at vertex " +
                             std::to_string(corner.vertex) + " has not three chains but " +
                             std::to_string(corner.valence),
                         {corner.vertex});
    }
}

}  // namespace detail

}  // namespace pavior
