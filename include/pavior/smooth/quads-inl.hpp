#pragma once

#include <pavior/smooth/detail/cartesian_model.hpp>
#include <pavior/smooth/quads.hpp>

#include <cstdint>
#include <span>

namespace pavior {

PAVIOR_INLINE SmoothReport untangle_quads(std::span<Vec2> nodes, std::span<const QuadCorners> quads,
                                          std::span<const std::uint8_t> fixed, const UntangleOptions& options,
                                          std::span<const Vec2> reference) {
    return detail::untangle_cartesian<2>(nodes, quads, fixed, options, reference);
}

}  // namespace pavior
