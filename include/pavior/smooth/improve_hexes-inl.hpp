#pragma once

#include <pavior/core/error.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <cstddef>
#include <string>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_options(const ImproveOptions& options) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) {
            throw InputError(ErrorCode::bad_option, message);
        }
    };
    require(options.target > 0.0 && options.target <= 1.0, "ImproveOptions::target must lie in (0, 1]");
    require(options.sufficient >= 0.0 && options.sufficient <= 1.0, "ImproveOptions::sufficient must lie in [0, 1]");
    require(options.gain > 0.0 && options.gain <= 0.5, "ImproveOptions::gain must lie in (0, 0.5]");
    require(options.rings >= 1 && options.rings <= 1000, "ImproveOptions::rings must lie in [1, 1000]");
    require(options.effort > 0.0, "ImproveOptions::effort must be above 0");
    require(options.attempts >= 1, "ImproveOptions::attempts must be at least 1");
}

PAVIOR_INLINE void check_guide(std::size_t known, std::size_t nodes) {
    if (known != nodes) {
        throw InputError(ErrorCode::size_mismatch,
                         "a guide of " + std::to_string(known) + " nodes for a mesh of " + std::to_string(nodes));
    }
}

}  // namespace detail

}  // namespace pavior
