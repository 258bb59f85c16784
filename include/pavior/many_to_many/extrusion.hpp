#pragma once
/// \file
/// Recognition of extrusions: directions in which every face of some solids is a cap or a side.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// What a face is to a direction.
enum class ExtrusionRole : std::uint8_t {
    none,  ///< neither
    side,  ///< its normal is perpendicular to the direction everywhere
    flat,  ///< a plane perpendicular to the direction
    cap    ///< its normal leans from the direction, by a limited angle: a graph over the plane
};

struct ExtrusionOptions {
    double side_tolerance = 1e-4;  ///< sine of the angle by which a side may lean
    double max_slope = 78;         ///< angle between the normal of a cap and the direction at most, degrees
};

/// A face that is neither cap nor side.
struct ExtrusionRefusal {
    FaceId face;
    double low = 0, high = 0;  ///< range of the angle between its normal and the direction, degrees, 0 .. 180
};

/// What the faces of some solids are to one direction.
struct Extrusion {
    Vec3 direction = Vec3::UnitZ();
    double side_tolerance = 0.0;       ///< ExtrusionOptions::side_tolerance by which the roles were given
    std::vector<ExtrusionRole> roles;  ///< by face id; none for faces of other solids
    std::size_t caps = 0;              ///< flat or not
    std::size_t slanted = 0;           ///< caps that are not flat
    std::vector<ExtrusionRefusal> refusals;

    [[nodiscard]] bool possible() const { return refusals.empty(); }
};

namespace detail {

/// Parameters on a face: points along its boundary, and middles between them.
template <brep B>
[[nodiscard]] std::vector<Vec2> face_samples(const B& b, FaceId face) {
    constexpr std::size_t per_edge = 5;
    std::vector<Vec2> samples;
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            const auto range = b.edge_range(use.edge);
            for (std::size_t i = 0; i < per_edge; ++i) {
                const double t = range[0] + (range[1] - range[0]) * (static_cast<double>(i) + 0.5) / per_edge;
                samples.push_back(b.edge_on_face(use.edge, t, face, use.forward));
            }
        }
    }
    const std::size_t n = samples.size();
    for (std::size_t i = 0; i < n; ++i) {
        samples.emplace_back(0.5 * (samples[i] + samples[(i + n / 3) % n]));
        samples.emplace_back(0.5 * (samples[i] + samples[(i + n / 2) % n]));
    }
    return samples;
}

/// Calls visit(uv, normal) with the unit normal (d/du x d/dv) at each sample of a face, degenerate points left out.
template <brep B, class Visit>
void for_each_normal(const B& b, FaceId face, Visit&& visit) {
    for (const Vec2& uv : face_samples(b, face)) {
        const auto [du, dv] = b.face_derivatives(face, uv);
        const Vec3 normal = du.cross(dv);
        if (normal.norm() > 1e-12 * du.norm() * dv.norm() && normal.allFinite()) {
            visit(uv, Vec3(normal.normalized()));
        }
    }
}

/// Unit normals of a face at its samples.
template <brep B>
[[nodiscard]] std::vector<Vec3> face_normals(const B& b, FaceId face) {
    std::vector<Vec3> normals;
    for_each_normal(b, face, [&](const Vec2&, const Vec3& normal) { normals.push_back(normal); });
    return normals;
}

/// The faces of some solids, each once, ascending.
template <brep B>
[[nodiscard]] std::vector<FaceId> faces_of(const B& b, std::span<const SolidId> solids) {
    std::vector<FaceId> faces;
    for (const SolidId s : solids) {
        for (const OrientedFace& f : b.solid_faces(s)) {
            faces.push_back(f.face);
        }
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

/// The role of a face with these normals; the range of angles is set where there is none.
[[nodiscard]] PAVIOR_INLINE ExtrusionRole role_of(std::span<const Vec3> normals, const Vec3& direction,
                                                  const ExtrusionOptions& options, ExtrusionRefusal& refusal);

/// Appends a direction unless it or its opposite is there; axes are met exactly.
PAVIOR_INLINE void add_direction(std::vector<Vec3>& directions, Vec3 d);

}  // namespace detail

/// What the faces of \p solids are to \p direction. Normals are sampled along the boundary of each face and between, so
/// a surface that misbehaves between samples is not noticed. O(edges).
template <brep B>
[[nodiscard]] Extrusion extrusion_along(const B& b, std::span<const SolidId> solids, const Vec3& direction,
                                        const ExtrusionOptions& options = {}) {
    Extrusion result;
    result.direction = direction.normalized();
    result.side_tolerance = options.side_tolerance;
    result.roles.assign(b.face_count(), ExtrusionRole::none);
    for (const FaceId f : detail::faces_of(b, solids)) {
        ExtrusionRefusal refusal{f, 0, 0};
        const ExtrusionRole role = detail::role_of(detail::face_normals(b, f), result.direction, options, refusal);
        result.roles[f.index()] = role;
        result.caps += role == ExtrusionRole::flat || role == ExtrusionRole::cap ? 1U : 0U;
        result.slanted += role == ExtrusionRole::cap ? 1U : 0U;
        if (role == ExtrusionRole::none) {
            result.refusals.push_back(refusal);
        }
    }
    return result;
}

/// Every face is a cap or a side, as extrusion_along() sees it; stops at the first that is not.
template <brep B>
[[nodiscard]] bool is_extrusion(const B& b, std::span<const SolidId> solids, const Vec3& direction,
                                const ExtrusionOptions& options = {}) {
    ExtrusionRefusal refusal;
    const std::vector<FaceId> faces = detail::faces_of(b, solids);
    return std::none_of(faces.begin(), faces.end(), [&](FaceId f) {
        return detail::role_of(detail::face_normals(b, f), direction.normalized(), options, refusal) ==
               ExtrusionRole::none;
    });
}

/// All directions worth a try, best first: possible ones before others, then by the number of caps, slanted ones
/// counted three times; of the impossible ones those with the fewest refusals. Candidates are the normals of plane
/// faces, the directions of straight edges, and the directions perpendicular to two faces (axes of cylinders, common
/// tangents).
template <brep B>
[[nodiscard]] std::vector<Extrusion> recognise_extrusions(const B& b, std::span<const SolidId> solids,
                                                          const ExtrusionOptions& options = {}) {
    constexpr std::size_t most = 200;  // directions
    std::vector<Vec3> directions;
    const std::vector<FaceId> faces = detail::faces_of(b, solids);
    std::vector<Vec3> normals;  // of plane faces; two of each curved one
    for (const FaceId f : faces) {
        const std::vector<Vec3> samples = detail::face_normals(b, f);
        for (const Vec3& n : samples) {
            if (n.cross(samples.front()).norm() > 0.1) {
                detail::add_direction(directions, n.cross(samples.front()));
                break;
            }
        }
        if (!samples.empty()) {
            detail::add_direction(normals, samples.front());
        }
    }
    for (const Vec3& n : normals) {
        detail::add_direction(directions, n);
    }
    for (const FaceId f : faces) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                const auto range = b.edge_range(use.edge);
                const Vec3 first = b.edge_derivative(use.edge, range[0]);
                const Vec3 last = b.edge_derivative(use.edge, range[1]);
                if (directions.size() < most && first.cross(last).norm() < 1e-9 * first.norm() * last.norm()) {
                    detail::add_direction(directions, first);
                }
            }
        }
    }
    std::vector<Extrusion> result;
    for (const Vec3& d : directions) {
        result.push_back(extrusion_along(b, solids, d, options));
    }
    const auto rank = [](const Extrusion& e) { return std::pair(e.refusals.size(), e.caps + 2 * e.slanted); };
    std::stable_sort(result.begin(), result.end(),
                     [&](const Extrusion& x, const Extrusion& y) { return rank(x) < rank(y); });
    return result;
}

/// Why solids are no extrusion, after the best direction that was tried.
template <brep B>
[[nodiscard]] UnmeshableError extrusion_error(const B& b, const Extrusion& best) {
    const auto number = [](double x) {
        std::string text = std::to_string(x);
        return text.substr(0, text.find('.') + 2);
    };
    std::string text = "no direction in which every face is a cap or a side; the best is (" +
                       number(best.direction[0]) + ", " + number(best.direction[1]) + ", " + number(best.direction[2]) +
                       "), but there";
    Error::Ids ids;
    for (const ExtrusionRefusal& refusal : best.refusals) {
        const int tag = b.tag(2, refusal.face.index());
        ids.push_back(tag);
        text += "\n  face " + std::to_string(tag) + " leans: its normal is " + number(refusal.low) + " to " +
                number(refusal.high) + " degrees from the direction";
    }
    return {ErrorCode::not_sweepable, text, ids};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/extrusion-inl.hpp>
#endif
