#pragma once

#include <pavior/sweep/target_projection.hpp>

#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<Vec2> plane_coordinates(std::span<const Vec3> nodes, std::span<const QuadCorners> quads) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : nodes) {
        centre += x / static_cast<double>(nodes.size());
    }
    Vec3 area = Vec3::Zero();
    double total = 0.0;
    for (const QuadCorners& q : quads) {
        const Vec3 a = quad_vector_area(detail::gather(nodes, q));
        area += a;
        total += a.norm();
    }
    if (!(area.norm() > 1e-10 * total)) {
        throw InputError(ErrorCode::null_pseudo_area, "the quads of the cap enclose no area: it has no normal");
    }
    const Vec3 normal = area.normalized();
    const Vec3 e1 = normal.unitOrthogonal();
    const Vec3 e2 = normal.cross(e1);
    std::vector<Vec2> uv;
    uv.reserve(nodes.size());
    for (const Vec3& x : nodes) {
        uv.emplace_back((x - centre).dot(e1), (x - centre).dot(e2));
    }
    return uv;
}

}  // namespace pavior
