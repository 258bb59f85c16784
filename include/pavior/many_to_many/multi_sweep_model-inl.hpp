#pragma once

#include <pavior/many_to_many/multi_sweep_model.hpp>

#include <cstddef>
#include <string>

namespace pavior {

PAVIOR_INLINE UnmeshableError no_mesh_error(const BestMultiSweep& best) {
    if (best.attempts.empty()) {
        return {ErrorCode::not_sweepable, "no time was left to try a direction"};
    }
    const MultiSweepAttempt& first = best.attempts.front();
    const std::size_t colon = first.error.find(": ");
    return {ErrorCode::not_sweepable, colon == std::string::npos ? first.error : first.error.substr(colon + 2),
            first.tags};
}

}  // namespace pavior
