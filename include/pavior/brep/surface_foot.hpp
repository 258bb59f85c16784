#pragma once
/// \file
/// The point of a face next to a point whose place is roughly known: a few evaluations instead of a projection.

#include <pavior/brep/brep.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pavior {

/// A point of a face next to another one.
struct SurfaceFoot {
    Vec2 uv{Vec2::Zero()};
    double distance = 0;
    /// The two derivatives span a plane there: not so at poles, where one of the parameters is arbitrary.
    bool regular = true;
};

/// Gauss-Newton from \p start to the foot of \p x on face \p f, the offset square to the surface; a step no longer than
/// \p last is the last one, and is taken in the tangent plane (the distance is off by half its square times the
/// curvature at most). Nothing where the steps do not come closer, or meet a point that is not regular. The foot
/// may be another than the closest point of the surface. Two evaluations a step, 1 or 2 steps as a rule.
template <brep B>
[[nodiscard]] std::optional<SurfaceFoot> surface_foot(const B& b, FaceId f, const Vec3& x, const Vec2& start,
                                                      double last) {
    constexpr int most_steps = 12;
    Vec3 gap = x - b.face_point(f, start);
    SurfaceFoot foot{start, gap.norm(), true};
    for (int i = 0; i < most_steps; ++i) {
        const auto [du, dv] = b.face_derivatives(f, foot.uv);
        const double uu = du.squaredNorm(), uv = du.dot(dv), vv = dv.squaredNorm();
        const double determinant = uu * vv - uv * uv;
        if (!(determinant > 1e-16 * uu * vv)) {
            return std::nullopt;
        }
        const Vec2 step(vv * du.dot(gap) - uv * dv.dot(gap), uu * dv.dot(gap) - uv * du.dot(gap));
        const Vec2 by = step / determinant;
        const double length = (du * by[0] + dv * by[1]).norm();
        if (length <= std::max(last, 1e-6 * foot.distance)) {  // of a far point no nearer than rounding admits
            return SurfaceFoot{foot.uv + by, (gap - du * by[0] - dv * by[1]).norm(), true};
        }
        SurfaceFoot next{foot.uv + by, 0, true};
        Vec3 next_gap = x - b.face_point(f, next.uv);
        next.distance = next_gap.norm();
        for (int halved = 0; halved < 2 && !(next.distance < foot.distance); ++halved) {
            next.uv = 0.5 * (next.uv + foot.uv);
            next_gap = x - b.face_point(f, next.uv);
            next.distance = next_gap.norm();
        }
        if (!(next.distance < foot.distance)) {
            return std::nullopt;
        }
        foot = next;
        gap = next_gap;
    }
    return std::nullopt;
}

/// The foot of \p x by projection (closest_on_face()).
template <brep B>
[[nodiscard]] SurfaceFoot projected_foot(const B& b, FaceId f, const Vec3& x) {
    SurfaceFoot foot;
    foot.uv = b.closest_on_face(f, x);
    foot.distance = (b.face_point(f, foot.uv) - x).norm();
    const auto [du, dv] = b.face_derivatives(f, foot.uv);
    foot.regular = du.cross(dv).squaredNorm() > 1e-16 * du.squaredNorm() * dv.squaredNorm();
    return foot;
}

}  // namespace pavior
