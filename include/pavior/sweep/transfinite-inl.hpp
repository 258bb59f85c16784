#pragma once

#include <pavior/sweep/transfinite.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<QuadCorners> structured_quads(std::size_t columns, std::size_t rows) {
    std::vector<QuadCorners> quads;
    quads.reserve(columns * rows);
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t i = 0; i < columns; ++i) {
            const auto a = static_cast<Index>(k * (columns + 1) + i);
            const auto b = static_cast<Index>(a + columns + 1);
            quads.push_back({a, a + 1, b + 1, b});
        }
    }
    return quads;
}

}  // namespace pavior
