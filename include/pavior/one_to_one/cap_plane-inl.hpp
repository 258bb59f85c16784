#pragma once

#include <pavior/one_to_one/cap_plane.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::optional<CapPlane> plane_of_loops(std::span<const std::vector<Vec3>> loops) {
    CapPlane plane;
    std::size_t count = 0;
    for (const std::vector<Vec3>& loop : loops) {
        for (const Vec3& p : loop) {
            plane.origin += p;
            ++count;
        }
    }
    plane.origin /= static_cast<double>(std::max<std::size_t>(count, 1));
    Vec3 area = Vec3::Zero();
    double sum = 0;
    for (const std::vector<Vec3>& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 piece = (loop[i] - plane.origin).cross(loop[(i + 1) % loop.size()] - plane.origin);
            area += piece;
            sum += piece.norm();
        }
    }
    if (!(area.norm() > 1e-6 * sum)) {
        return std::nullopt;
    }
    plane.x = area.normalized().unitOrthogonal();
    plane.y = area.normalized().cross(plane.x);
    return plane;
}

}  // namespace pavior
