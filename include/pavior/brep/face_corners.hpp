#pragma once
/// \file
/// Interior angles of faces at their vertices, turning and normals of edges: what tells a corner from a mere vertex.

#include <pavior/brep/brep.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pavior {

namespace detail {

inline constexpr double degrees_per_radian = 57.295779513082320876798154814105;

/// Unit direction of \p use at its start (at = 0) or end (at = 1), in the sense of the use. Where the derivative
/// vanishes or \p chord > 0, the direction of the chord over that fraction of the edge. Zero for a degenerate edge.
template <brep B>
[[nodiscard]] Vec3 use_direction(const B& b, OrientedEdge use, int at, double chord = 0.0) {
    const auto range = b.edge_range(use.edge);
    const bool at_last = use.forward == (at == 1);
    const double t = at_last ? range[1] : range[0];
    const double sense = use.forward ? 1.0 : -1.0;
    if (chord <= 0.0) {
        const Vec3 d = b.edge_derivative(use.edge, t) * (range[1] - range[0]);
        if (d.norm() > 1e-9 * b.edge_length(use.edge)) {
            return sense * d.normalized();
        }
        chord = 1e-3;
    }
    const double step = chord * (range[1] - range[0]);
    const Vec3 d = at_last ? Vec3(b.edge_point(use.edge, t) - b.edge_point(use.edge, t - step))
                           : Vec3(b.edge_point(use.edge, t + step) - b.edge_point(use.edge, t));
    return d.squaredNorm() > 0.0 ? Vec3(sense * d.normalized()) : Vec3(Vec3::Zero());
}

/// Angle from \p a to \p b about \p axis in degrees, in (-180, 180].
[[nodiscard]] inline double signed_angle(const Vec3& a, const Vec3& b, const Vec3& axis) {
    return degrees_per_radian * std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

}  // namespace detail

/// The unit normal of a face that leaves the solid, at parameters \p uv; not finite where the face has none.
template <brep B>
[[nodiscard]] Vec3 outward_normal(const B& b, const OrientedFace& f, const Vec2& uv) {
    const auto [du, dv] = b.face_derivatives(f.face, uv);
    return (f.outward ? 1.0 : -1.0) * du.cross(dv).normalized();
}

/// Unit normal of face \p f, pointing out of the solid that uses it, at fraction \p at in [0, 1] along the boundary
/// edge \p use, where \p use runs in the sense of the face's loop as seen from outside that solid.
/// At a singular point of the parametrisation the normal a little further inside the edge; zero if that fails too.
template <brep B>
[[nodiscard]] Vec3 outside_normal(const B& b, OrientedFace f, OrientedEdge use, double at) {
    const auto range = b.edge_range(use.edge);
    const bool own_sense = use.forward == f.outward;
    for (const double shift : {0.0, 1e-3, 5e-2}) {
        const double inside = at + (0.5 - at) * shift;
        const double t = range[0] + (use.forward ? inside : 1.0 - inside) * (range[1] - range[0]);
        const auto d = b.face_derivatives(f.face, b.edge_on_face(use.edge, t, f.face, own_sense));
        const Vec3 normal = d.first.cross(d.second);
        const double scale = d.first.norm() * d.second.norm();
        if (scale > 0.0 && normal.norm() > 1e-9 * scale) {
            return normal.normalized() * (f.outward ? 1.0 : -1.0);
        }
    }
    return Vec3::Zero();
}

/// Angle inside the solid between two faces at fraction \p at of an edge, in [0, 360] degrees; \p use is the edge in
/// the sense of the first face's loop seen from outside.
template <brep B>
[[nodiscard]] double dihedral_angle(const B& b, OrientedFace first, OrientedFace second, OrientedEdge use, double at) {
    const auto range = b.edge_range(use.edge);
    const double t = range[0] + (use.forward ? at : 1.0 - at) * (range[1] - range[0]);
    const Vec3 along = b.edge_derivative(use.edge, t) * (use.forward ? 1.0 : -1.0);
    const OrientedEdge other{use.edge, !use.forward};
    return 180.0 - detail::signed_angle(outside_normal(b, first, use, at), outside_normal(b, second, other, 1.0 - at),
                                        along.norm() > 0.0 ? Vec3(along.normalized()) : along);
}

/// Interior angle in degrees, in [0, 360], of face \p f between the consecutive boundary edges \p in and \p out, both
/// in the sense of the face's loop as seen from outside the solid (counter-clockwise). 90 at a corner of a square, 180
/// where the boundary goes straight on, 270 at a notch. Cost: a few evaluations of the model.
template <brep B>
[[nodiscard]] double corner_angle(const B& b, OrientedFace f, OrientedEdge in, OrientedEdge out) {
    const Vec3 normal = outside_normal(b, f, out, 0.0);
    double turn = detail::signed_angle(detail::use_direction(b, in, 1), detail::use_direction(b, out, 0), normal);
    if (std::abs(turn) > 175.0) {  // a cusp: which side it lies on is told by the chords
        turn =
            detail::signed_angle(detail::use_direction(b, in, 1, 0.05), detail::use_direction(b, out, 0, 0.05), normal);
    }
    return 180.0 - turn;
}

/// Total turning of the tangent along edge \p e in degrees: 0 for a straight edge, 360 for a circle. Computed from
/// \p pieces chords, hence a little less than the truth for a wavy curve. 0 for a degenerate edge.
template <brep B>
[[nodiscard]] double edge_turning(const B& b, EdgeId e, std::size_t pieces = 32) {
    const auto range = b.edge_range(e);
    const double step = (range[1] - range[0]) / static_cast<double>(pieces);
    Vec3 last = detail::use_direction(b, {e, true}, 0);
    Vec3 point = b.edge_point(e, range[0]);
    double sum = 0.0;
    const auto add = [&](const Vec3& direction) {
        if (direction.squaredNorm() > 0.0) {
            sum += std::atan2(last.cross(direction).norm(), last.dot(direction));
            last = direction;
        }
    };
    for (std::size_t i = 1; i <= pieces; ++i) {
        const Vec3 next = b.edge_point(e, i == pieces ? range[1] : range[0] + static_cast<double>(i) * step);
        add((next - point).normalized());
        point = next;
    }
    add(detail::use_direction(b, {e, true}, 1));
    return detail::degrees_per_radian * sum;
}

}  // namespace pavior
