#pragma once

#include <pavior/lattice/signed_axis.hpp>

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<CubeTurn> cube_turns() {
    std::vector<CubeTurn> result;
    for (std::size_t a = 0; a < 3; ++a) {
        for (const int s : {1, -1}) {
            for (std::size_t b = 0; b < 3; ++b) {
                for (const int t : {1, -1}) {
                    const SignedAxis i = signed_axis(a, s), j = signed_axis((a + 1 + b) % 3, t);
                    if (i.axis() != j.axis()) {
                        result.push_back({{i, j, cross(i, j)}});
                    }
                }
            }
        }
    }
    return result;
}

}  // namespace pavior
