#pragma once
// What must hold for the cut candidates of any solid.
#include "support/catch.hpp"

#include <pavior/decompose/cut_candidates.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

namespace pavior::test {

/// Points of the edges and faces of a solid.
template <brep B>
std::vector<Vec3> boundary_points(const B& b, SolidId solid) {
    std::vector<Vec3> points;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        for (const EdgeLoop& loop : b.face_loops(f.face)) {
            for (const OrientedEdge& use : loop) {
                const auto range = b.edge_range(use.edge);
                for (int i = 0; i <= 16; ++i) {
                    points.push_back(b.edge_point(use.edge, range[0] + (range[1] - range[0]) * i / 16));
                }
            }
        }
        for (const Vec2& uv : detail::face_samples(b, f.face)) {  // inside a disc, too
            points.push_back(b.face_point(f.face, uv));
        }
    }
    return points;
}

/// The candidates, after a look at them: surfaces are sound and leave points of the solid on both sides, no candidate
/// has the same surfaces as another.
template <brep B>
std::vector<CutCandidate> checked_candidates(const B& b, SolidId solid) {
    const std::vector<CutCandidate> result = cut_candidates(b, solid);
    const std::vector<Vec3> points = boundary_points(b, solid);
    const double unit = 1e-9;
    for (std::size_t c = 0; c < result.size(); ++c) {
        CAPTURE(c, to_string(result[c].reason));
        CHECK(result[c].surfaces.empty() == (result[c].reason == CutReason::square));
        CHECK(result[c].curves.empty() != (result[c].reason == CutReason::square));
        for (const CutSurface& surface : result[c].surfaces) {
            double low = std::numeric_limits<double>::infinity();
            double high = -low;
            for (const Vec3& x : points) {
                low = std::min(low, signed_distance(surface, x));
                high = std::max(high, signed_distance(surface, x));
            }
            CHECK(low < 0);
            CHECK(high > 0);
            if (const auto* plane = std::get_if<CutPlane>(&surface)) {
                CHECK(std::abs(plane->normal.norm() - 1) < unit);
            } else if (const auto* half = std::get_if<CutHalfPlane>(&surface)) {
                CHECK(std::abs(half->along.norm() - 1) < unit);
                CHECK(std::abs(half->into.norm() - 1) < unit);
                CHECK(std::abs(half->along.dot(half->into)) < unit);
            } else if (const auto* cylinder = std::get_if<CutCylinder>(&surface)) {
                CHECK(cylinder->radius > 0);
                CHECK(std::abs(cylinder->direction.norm() - 1) < unit);
                CHECK(std::abs(cylinder->seam.norm() - 1) < unit);
                CHECK(std::abs(cylinder->seam.dot(cylinder->direction)) < 1e-6);
            }
        }
        for (std::size_t other = 0; other < c; ++other) {
            const auto& x = result[c].surfaces;
            const auto& y = result[other].surfaces;
            const bool same = !x.empty() && std::is_permutation(x.begin(), x.end(), y.begin(), y.end(),
                                                                [](const CutSurface& s, const CutSurface& t) {
                                                                    return same_surface(s, t, 1e-7);
                                                                });
            CHECK_FALSE(same);
        }
    }
    return result;
}

/// Whether one of the candidates is this surface and no other.
inline bool has_single(const std::vector<CutCandidate>& candidates, const CutSurface& surface) {
    return std::any_of(candidates.begin(), candidates.end(), [&](const CutCandidate& c) {
        return c.surfaces.size() == 1 && same_surface(c.surfaces[0], surface, 1e-6);
    });
}

/// How many candidates cut for a reason.
inline std::size_t count_of(const std::vector<CutCandidate>& candidates, CutReason reason) {
    return static_cast<std::size_t>(
        std::count_if(candidates.begin(), candidates.end(), [&](const CutCandidate& c) { return c.reason == reason; }));
}

template <class Surface>
bool any_is(const std::vector<CutSurface>& surfaces) {
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [](const CutSurface& s) { return std::holds_alternative<Surface>(s); });
}

}  // namespace pavior::test
