#pragma once
/// \file
/// The six directions of a logical grid and the 24 turns of a cube.

#include <pavior/core/compiled.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior {

/// A logical direction: +1, +2, +3 for i, j, k and the negative for the opposite; 0 for none.
struct SignedAxis {
    std::int8_t value = 0;

    [[nodiscard]] constexpr bool valid() const { return value != 0; }
    /// 0, 1 or 2 for i, j, k.
    [[nodiscard]] constexpr std::size_t axis() const {
        return static_cast<std::size_t>(value > 0 ? value : -value) - 1;
    }
    [[nodiscard]] constexpr int sign() const { return value > 0 ? 1 : -1; }
    [[nodiscard]] constexpr SignedAxis operator-() const { return {static_cast<std::int8_t>(-value)}; }
    friend constexpr auto operator<=>(SignedAxis, SignedAxis) = default;
};

[[nodiscard]] constexpr SignedAxis signed_axis(std::size_t axis, int sign) {
    return {static_cast<std::int8_t>(sign * static_cast<int>(axis + 1))};
}

/// Vector product of two directions; none if they are parallel.
[[nodiscard]] constexpr SignedAxis cross(SignedAxis a, SignedAxis b) {
    if (a.axis() == b.axis()) {
        return {};
    }
    const int order = (b.axis() + 3 - a.axis()) % 3 == 1 ? 1 : -1;
    return signed_axis(3 - a.axis() - b.axis(), order * a.sign() * b.sign());
}

/// \p d turned by \p quarters right angles about \p about, in the right-hand sense.
[[nodiscard]] constexpr SignedAxis turned(SignedAxis d, SignedAxis about, int quarters) {
    if (d.axis() == about.axis()) {
        return d;
    }
    switch (((quarters % 4) + 4) % 4) {
        case 1: return cross(about, d);
        case 2: return -d;
        case 3: return -cross(about, d);
        default: return d;
    }
}

/// A turn of the cube: what i, j, k become.
struct CubeTurn {
    std::array<SignedAxis, 3> image{SignedAxis{1}, SignedAxis{2}, SignedAxis{3}};

    [[nodiscard]] constexpr SignedAxis operator()(SignedAxis d) const {
        return d.sign() > 0 ? image[d.axis()] : -image[d.axis()];
    }
};

/// All 24, the identity first.
[[nodiscard]] PAVIOR_INLINE std::vector<CubeTurn> cube_turns();

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/signed_axis-inl.hpp>
#endif
