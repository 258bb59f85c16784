#pragma once

#include <pavior/smooth/detail/cartesian_model.hpp>
#include <pavior/smooth/hexes.hpp>

#include <cstdint>
#include <span>

namespace pavior {

PAVIOR_INLINE SmoothReport untangle_hexes(std::span<Vec3> nodes, std::span<const HexCorners> hexes,
                                          std::span<const std::uint8_t> fixed, const UntangleOptions& options,
                                          std::span<const Vec3> reference) {
    return detail::untangle_cartesian<3>(nodes, hexes, fixed, options, reference);
}

}  // namespace pavior
