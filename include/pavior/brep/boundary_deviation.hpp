#pragma once
/// \file
/// How far the quads of a boundary are from the faces that they stand for, and how much volume lies between.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/face_distance.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// What boundary_deviation() found.
struct BoundaryDeviation {
    double distance = 0;             ///< largest distance of a corner or a centre of a quad from its face
    std::size_t quad = no_position;  ///< the first quad with it; no_position at distance 0
    double volume = 0;               ///< between the quads and their faces, an upper estimate
    std::size_t quads = 0;           ///< so many were looked at
    std::size_t projections = 0;     ///< calls of closest_on_face()
};

namespace detail {

[[nodiscard]] inline double quad_area(const std::array<Vec3, 4>& x) {
    return 0.5 * ((x[1] - x[0]).cross(x[2] - x[0]).norm() + (x[2] - x[0]).cross(x[3] - x[0]).norm());
}

/// Measures quads one after the other; parameters of nodes are found once a face, from those of their neighbours.
template <brep B>
class QuadMeasure {
public:
    QuadMeasure(const B& b, std::span<const Vec3> nodes)
        : b_(b), nodes_(nodes), face_(nodes.size()), foot_(nodes.size()) {}

    void measure(std::size_t number, const QuadCorners& quad, FaceId face, BoundaryDeviation& result) {
        face_of_quad_ = face;
        for (std::size_t k = 0; k < 4; ++k) {
            x_[k] = nodes_[quad[k]];
        }
        size_ = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            size_ = std::max(size_, (x_[(k + 1) % 4] - x_[k]).norm());
        }
        place_corners(quad, result.projections);
        double corners = 0;
        for (const SurfaceFoot& foot : at_) {
            corners = std::max(corners, foot.distance);
        }
        const double centre = centre_distance(result.projections);
        constexpr double margin = 1.5;
        result.volume += margin * quad_area(x_) * std::max(corners, centre);
        if (std::max(corners, centre) > result.distance) {
            result.distance = std::max(corners, centre);
            result.quad = number;
        }
        ++result.quads;
    }

private:
    /// Corners whose place on the face is known already go first, so that the others start from them.
    void place_corners(const QuadCorners& quad, std::size_t& projections) {
        std::array<bool, 4> known{};
        for (std::size_t k = 0; k < 4; ++k) {
            known[k] = face_[quad[k]] == face_of_quad_;
            at_[k] = known[k] ? foot_[quad[k]] : SurfaceFoot{};
        }
        for (int left = static_cast<int>(std::count(known.begin(), known.end(), false)); left > 0; --left) {
            const auto is_start = [&](std::size_t k) { return known[k] && at_[k].regular; };
            std::size_t next = no_position, from = no_position;
            for (std::size_t k = 0; k < 4; ++k) {
                for (const std::size_t other : {(k + 1) % 4, (k + 3) % 4, (k + 2) % 4}) {
                    if (!known[k] && from == no_position && is_start(other)) {
                        next = k;
                        from = other;
                    }
                }
            }
            if (next == no_position) {
                next = static_cast<std::size_t>(std::find(known.begin(), known.end(), false) - known.begin());
            }
            const std::optional<Vec2> start =
                from == no_position ? std::nullopt : std::optional(start_of(next, from, is_start));
            at_[next] = foot(x_[next], start, projections);
            known[next] = true;
            face_[quad[next]] = face_of_quad_;
            foot_[quad[next]] = at_[next];
        }
    }

    /// Where to look for a corner: across from the opposite one where the other three are known, else at a neighbour.
    template <class Known>
    [[nodiscard]] Vec2 start_of(std::size_t corner, std::size_t from, const Known& known) const {
        const std::size_t a = (corner + 1) % 4, across = (corner + 2) % 4, b = (corner + 3) % 4;
        if (!known(a) || !known(across) || !known(b)) {
            return at_[from].uv;
        }
        return near(at_[a].uv, at_[from].uv) + near(at_[b].uv, at_[from].uv) - near(at_[across].uv, at_[from].uv);
    }

    /// \p uv moved by whole periods as near to \p reference as can be.
    [[nodiscard]] Vec2 near(Vec2 uv, const Vec2& reference) const {
        const std::array<double, 2> period = b_.face_period(face_of_quad_);
        for (Eigen::Index d = 0; d < 2; ++d) {
            const double p = period[static_cast<std::size_t>(d)];
            uv[d] += p > 0 ? p * std::round((reference[d] - uv[d]) / p) : 0;
        }
        return uv;
    }

    /// The distance of the centre.
    [[nodiscard]] double centre_distance(std::size_t& projections) const {
        std::optional<Vec2> first;
        Vec2 sum = Vec2::Zero();
        double count = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            if (!at_[k].regular) {
                continue;
            }
            first = first ? first : std::optional(at_[k].uv);
            sum += near(at_[k].uv, *first);
            count += 1;
        }
        const Vec3 x = 0.25 * (x_[0] + x_[1] + x_[2] + x_[3]);
        return foot(x, first ? std::optional<Vec2>(sum / count) : std::nullopt, projections).distance;
    }

    /// From \p start, or by projection where that leads nowhere or not near enough to be sure of it.
    [[nodiscard]] SurfaceFoot foot(const Vec3& x, const std::optional<Vec2>& start, std::size_t& projections) const {
        constexpr double near_enough = 0.1, last_step = 0.02;  // 1e-4 or so off
        std::optional<SurfaceFoot> found;
        if (start) {
            found = surface_foot(b_, face_of_quad_, x, *start, last_step * size_);
        }
        if (found && found->distance <= near_enough * size_) {
            return *found;
        }
        ++projections;
        const SurfaceFoot projected = projected_foot(b_, face_of_quad_, x);
        return found && found->distance < projected.distance ? *found : projected;
    }

    const B& b_;
    std::span<const Vec3> nodes_;
    std::vector<FaceId> face_;  ///< the face for which foot_ is known
    std::vector<SurfaceFoot> foot_;
    FaceId face_of_quad_;
    double size_ = 0;
    std::array<Vec3, 4> x_;
    std::array<SurfaceFoot, 4> at_;
};

}  // namespace detail

/// Measures \p quads, one after the other, against the faces they lie on. The volume is the sum of area times the
/// largest distance of corners and centre, half as much again: to second order a mesh whose boundary nodes are on the
/// faces differs in volume from the solid by no more than 4/9 of that. Distances are exact to some 1e-4 of the size of
/// a quad.
/// \param faces  the face of each quad
/// \param go_on  asked before each quad, with what was found so far; false ends the work
/// O(quads), about five evaluations each and hardly any projection where the quads of a face are listed next to each
/// other. \throws InputError size_mismatch
template <brep B, class GoOn>
[[nodiscard]] BoundaryDeviation boundary_deviation(const B& b, std::span<const Vec3> nodes,
                                                   std::span<const QuadCorners> quads, std::span<const FaceId> faces,
                                                   GoOn&& go_on) {
    detail::check_quad_faces(quads, faces);
    BoundaryDeviation result;
    detail::QuadMeasure<B> measure(b, nodes);
    for (std::size_t q = 0; q < quads.size() && go_on(std::as_const(result)); ++q) {
        measure.measure(q, quads[q], faces[q], result);
    }
    return result;
}

}  // namespace pavior
