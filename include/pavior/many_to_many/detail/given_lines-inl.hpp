#pragma once

#include <pavior/many_to_many/detail/given_lines.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE bool is_upright_grid(std::span<const Vec3> nodes, std::span<const QuadCorners> quads) {
    return std::all_of(quads.begin(), quads.end(), [&](const QuadCorners& q) {
        std::array<bool, 4> up{};
        for (std::size_t k = 0; k < 4; ++k) {
            up[k] = is_upright(nodes[q[k]], nodes[q[(k + 1) % 4]]);
        }
        return up[0] == up[2] && up[1] == up[3] && up[0] != up[1];
    });
}

PAVIOR_INLINE std::vector<std::array<Index, 2>> lines_off(const FaceMesh& mesh,
                                                          std::vector<std::pair<Index, Index>> along) {
    std::sort(along.begin(), along.end());
    std::vector<std::array<Index, 2>> result;
    for (const QuadCorners& q : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [i, j] = std::minmax(q[k], q[(k + 1) % 4]);
            const auto ids = std::minmax(mesh.nodes[i], mesh.nodes[j]);
            if (!std::binary_search(along.begin(), along.end(), std::pair<Index, Index>(ids.first, ids.second))) {
                result.push_back({i, j});
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace pavior::detail
