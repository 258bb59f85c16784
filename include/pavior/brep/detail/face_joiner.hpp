#pragma once
/// \file
/// Which faces of a model go on in each other.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/seamless.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/math/box.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// A point of a surface and its parameters.
struct SurfacePoint {
    Vec3 x;
    Vec2 uv;
};

/// Points on the edges of \p face, 4 each, and some of its surface between them; without a projection.
template <brep B>
[[nodiscard]] std::vector<SurfacePoint> surface_points(const B& b, FaceId face) {
    std::vector<SurfacePoint> result;
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            const auto range = b.edge_range(use.edge);
            for (const double part : {0.0, 0.27, 0.5, 0.81}) {
                const double t = range[0] + part * (range[1] - range[0]);
                result.push_back({b.edge_point(use.edge, t), b.edge_on_face(use.edge, t, face, use.forward)});
            }
        }
    }
    const std::size_t n = result.size();
    for (std::size_t i = 0; i < n; i += 3) {
        const Vec2 uv = 0.5 * (result[i].uv + result[(i + 1) % n].uv);
        result.push_back({b.face_point(face, uv), uv});
    }
    return result;
}

/// Parameters on \p face of a point \p of another face on the same surface: the same, or those of the foot from that
/// one of \p own, points of the face, which is nearest. Nothing if the surface is another, within \p tolerance.
template <brep B>
[[nodiscard]] std::optional<Vec2> on_surface(const B& b, FaceId face, std::span<const SurfacePoint> own,
                                             const SurfacePoint& of, double tolerance) {
    if ((b.face_point(face, of.uv) - of.x).norm() <= tolerance) {
        return of.uv;
    }
    const auto nearest = std::min_element(own.begin(), own.end(), [&](const SurfacePoint& p, const SurfacePoint& q) {
        return (p.x - of.x).squaredNorm() < (q.x - of.x).squaredNorm();
    });
    const std::optional<SurfaceFoot> foot = surface_foot(b, face, of.x, nearest->uv, 1e-3 * tolerance);
    return foot && foot->distance <= tolerance ? std::optional(foot->uv) : std::nullopt;
}

/// The unit normal of a face at parameters; zero where it has none.
template <brep B>
[[nodiscard]] Vec3 surface_normal(const B& b, FaceId face, const Vec2& uv) {
    const auto [du, dv] = b.face_derivatives(face, uv);
    return du.cross(dv).stableNormalized();
}

/// How two faces hang together.
enum class Joint : std::uint8_t {
    none,    ///< surfaces or solids differ
    same,    ///< one goes on in the other
    turned,  ///< it does, and its normal points the other way
};

/// The joints of faces of a model: which pairs go on in each other.
template <brep B>
class FaceJoiner {
public:
    explicit FaceJoiner(const B& b) : b_(b), owners_(b.face_count()), sets_(b.face_count()) {
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(b.solid_count()); ++s) {
            for (const OrientedFace& f : b.solid_faces(SolidId{s})) {
                owners_[f.face.index()].emplace_back(SolidId{s}, f.outward);
            }
        }
        std::vector<std::vector<FaceId>> at(b.edge_count());
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(b.face_count()); ++f) {
            for (const EdgeLoop& loop : b.face_loops(FaceId{f})) {
                for (const OrientedEdge& use : loop) {
                    at[use.edge.index()].push_back(FaceId{f});
                }
            }
        }
        for (const std::vector<FaceId>& pair : at) {
            if (pair.size() == 2 && pair[0] != pair[1] && !sets_.same(pair[0].index(), pair[1].index()) &&
                joint(pair[0], pair[1]) != Joint::none) {
                sets_.unite(pair[0].index(), pair[1].index());
            }
        }
    }

    /// The faces that are one, two or more each, ascending.
    [[nodiscard]] std::vector<std::vector<FaceId>> groups() {
        std::vector<std::vector<FaceId>> result(b_.face_count());
        for (std::size_t f = 0; f < result.size(); ++f) {
            result[sets_.root(f)].push_back(FaceId{static_cast<std::int32_t>(f)});
        }
        std::erase_if(result, [](const auto& group) { return group.size() < 2; });
        return result;
    }

    /// Whether \p g lies on the surface of \p f, and bounds the same solids on the same sides.
    [[nodiscard]] Joint joint(FaceId f, FaceId g) const {
        const auto& of_f = owners_[f.index()];
        const auto& of_g = owners_[g.index()];
        if (of_f.empty() || of_f.size() != of_g.size() || has_seam(b_, f) || has_seam(b_, g)) {
            return Joint::none;
        }
        const std::vector<SurfacePoint> own = surface_points(b_, f), other = surface_points(b_, g);
        Box<Vec3> box;
        for (const SurfacePoint& p : other) {
            box.add(p.x);
        }
        const double tolerance = 1e-7 * box.diagonal();
        double least = 1.0, most = -1.0;
        for (const SurfacePoint& p : other) {
            const std::optional<Vec2> uv = on_surface(b_, f, own, p, tolerance);
            if (!uv) {
                return Joint::none;
            }
            const double cosine = surface_normal(b_, f, *uv).dot(surface_normal(b_, g, p.uv));
            least = std::min(least, cosine);
            most = std::max(most, cosine);
        }
        constexpr double parallel = 1 - 1e-7;
        const bool same = least > parallel;
        if (!same && !(most < -parallel)) {
            return Joint::none;
        }
        const bool sides = std::all_of(of_f.begin(), of_f.end(), [&](const auto& owner) {
            return std::find(of_g.begin(), of_g.end(), std::pair(owner.first, owner.second == same)) != of_g.end();
        });
        return !sides ? Joint::none : same ? Joint::same : Joint::turned;
    }

private:
    const B& b_;
    std::vector<std::vector<std::pair<SolidId, bool>>> owners_;  ///< of each face
    DisjointSets<std::size_t> sets_;
};

}  // namespace pavior::detail
