#pragma once

#include <pavior/core/error.hpp>
#include <pavior/smooth/options.hpp>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_options(const UntangleOptions& options) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) {
            throw InputError(ErrorCode::bad_option, message);
        }
    };
    require(options.max_iterations >= 1, "UntangleOptions::max_iterations must be at least 1");
    require(options.inner_iterations >= 1, "UntangleOptions::inner_iterations must be at least 1");
    require(options.theta > 0.0 && options.theta < 1e12, "UntangleOptions::theta must be finite and above 0");
    require(options.sufficient_det >= 0.0 && options.sufficient_det < 1.0,
            "UntangleOptions::sufficient_det must lie in [0, 1)");
}

}  // namespace detail

}  // namespace pavior
