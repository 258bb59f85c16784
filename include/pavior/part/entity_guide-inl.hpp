#pragma once

#include <pavior/brep/surface_foot.hpp>
#include <pavior/part/entity_guide.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pavior {

namespace detail {

/// Whether an edge is straight, by eight points of it.
[[nodiscard]] inline bool is_straight(const AnyModel& b, EdgeId e) {
    const std::array<double, 2> range = b.edge_range(e);
    const Vec3 from = b.edge_point(e, range[0]);
    const Vec3 along = b.edge_point(e, range[1]) - from;
    const double length = along.norm();
    for (int i = 1; i < 8 && length > 0; ++i) {
        const Vec3 off = b.edge_point(e, range[0] + (range[1] - range[0]) * i / 8.0) - from;
        if (off.cross(along).norm() > 1e-12 * length * length) {
            return false;
        }
    }
    return length > 0;
}

}  // namespace detail

PAVIOR_INLINE EntityGuide::EntityGuide(const AnyModel& b, std::vector<NodeEntity> entities, double precision)
    : b_(b), entities_(std::move(entities)), precision_(precision), near_edge_(b) {
    for (const NodeEntity& on : entities_) {
        if (on.dimension == 1 && !lines_.contains(on.id)) {
            const EdgeId e{on.id};
            const std::array<double, 2> range = b.edge_range(e);
            const Vec3 from = b.edge_point(e, range[0]);
            lines_[on.id] =
                detail::is_straight(b, e) ? std::optional(Line{from, b.edge_point(e, range[1]) - from}) : std::nullopt;
            curved_ = curved_ || !lines_[on.id];
        } else if (on.dimension == 2 && !planes_.contains(on.id)) {
            planes_[on.id] = plane_of(b, FaceId{on.id});
            curved_ = curved_ || !planes_[on.id];
        }
    }
}

PAVIOR_INLINE Vec2 EntityGuide::parameters(Index i, const Vec3& x) const {
    const FaceId f{entities_[i].id};
    const std::optional<SurfaceFoot> foot = surface_foot(b_, f, x, entities_[i].uv, precision_);
    return foot ? foot->uv : b_.closest_on_face(f, x);
}

PAVIOR_INLINE Vec3 EntityGuide::project(Index i, const Vec3& x) const {
    const NodeEntity& on = entities_[i];
    if (on.dimension == 1) {
        if (const std::optional<Line>& line = lines_.at(on.id)) {
            const double part = (x - line->from).dot(line->along) / line->along.squaredNorm();
            return line->from + std::clamp(part, 0.0, 1.0) * line->along;
        }
        return b_.edge_point(EdgeId{on.id}, near_edge_.closest(EdgeId{on.id}, x).t);
    }
    if (const std::optional<FacePlane>& plane = planes_.at(on.id)) {
        return x - (x - plane->point).dot(plane->normal) * plane->normal;
    }
    return b_.face_point(FaceId{on.id}, parameters(i, x));
}

PAVIOR_INLINE Vec3 EntityGuide::direction(Index i, const Vec3& x) const {
    const NodeEntity& on = entities_[i];
    if (on.dimension == 1) {
        const std::optional<Line>& line = lines_.at(on.id);
        return line ? line->along : b_.edge_derivative(EdgeId{on.id}, near_edge_.closest(EdgeId{on.id}, x).t);
    }
    if (const std::optional<FacePlane>& plane = planes_.at(on.id)) {
        return plane->normal;
    }
    const auto [du, dv] = b_.face_derivatives(FaceId{on.id}, parameters(i, x));
    const Vec3 normal = du.cross(dv);
    return normal.squaredNorm() > 1e-16 * du.squaredNorm() * dv.squaredNorm() ? normal : Vec3(Vec3::Zero());
}

}  // namespace pavior
