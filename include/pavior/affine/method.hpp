#pragma once
/// \file
/// The affine projections offered, and their names.

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace pavior {

/// Which affine map takes the source loops to the target loops; Chapters 2 and 3 \cite roca2009.
enum class AffineMethod : std::uint8_t {
    constrained,  ///< least squares under A nX = nY with the pseudo-normals: the default, stable under noise
    h,            ///< Algorithm 3.1: offset-preserving, but discontinuous where a loop becomes planar
    g,            ///< minimises G: keeps offsets along cY - cX (skewing); singular if cY - cX lies in the plane of X
    f,            ///< minimises F: plain least squares (flattening, flipping, offset scaling)
};

/// "constrained", "h", "g" or "f".
[[nodiscard]] constexpr std::string_view to_string(AffineMethod method) noexcept {
    switch (method) {
        case AffineMethod::constrained: return "constrained";
        case AffineMethod::h: return "h";
        case AffineMethod::g: return "g";
        case AffineMethod::f: return "f";
    }
    return "unknown";
}

/// The method of that name (lower case, as to_string gives it), or nothing.
[[nodiscard]] constexpr std::optional<AffineMethod> affine_method_from_string(std::string_view name) noexcept {
    for (const auto method : {AffineMethod::constrained, AffineMethod::h, AffineMethod::g, AffineMethod::f}) {
        if (to_string(method) == name) {
            return method;
        }
    }
    return std::nullopt;
}

}  // namespace pavior
