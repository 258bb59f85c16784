#pragma once

#include <pavior/mesh/near_nodes.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void NodeGrid::add(const Vec3& x, Index node, std::vector<GridEntry>& entries) const {
    std::array<std::array<std::int64_t, 2>, 3> cells{};
    std::array<std::size_t, 3> counts{1, 1, 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        const double at = (x[a] - low_[a]) / cell_ + 0.5;
        const double base = std::floor(at);
        cells[axis][0] = static_cast<std::int64_t>(base);
        constexpr double reach = 1.001 / 16.0;
        if (at - base <= reach || at - base >= 1.0 - reach) {
            cells[axis][counts[axis]++] = cells[axis][0] + (at - base <= reach ? -1 : 1);
        }
    }
    for (std::size_t i = 0; i < counts[0]; ++i) {
        for (std::size_t j = 0; j < counts[1]; ++j) {
            for (std::size_t k = 0; k < counts[2]; ++k) {
                entries.push_back({hash(cells[0][i], cells[1][j], cells[2][k]), node, i + j + k != 0});
            }
        }
    }
}

PAVIOR_INLINE std::uint64_t NodeGrid::hash(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t h = 0;
    for (const std::int64_t part : {i, j, k}) {
        h = (h ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
        h ^= h >> 29U;
    }
    return h;
}

}  // namespace detail

}  // namespace pavior
