#pragma once
/// \file
/// Where a solid might be cut: the cuts that an analyst would look at.

#include <pavior/decompose/cut_lines.hpp>
#include <pavior/decompose/detail/round_lines.hpp>
#include <pavior/decompose/edge_angles.hpp>
#include <pavior/decompose/face_shape.hpp>
#include <pavior/decompose/solid_cut.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace pavior {

/// Surfaces to cut a solid with, together, and why; or curves to divide its faces.
struct CutCandidate {
    std::vector<CutSurface> surfaces;
    CutReason reason = CutReason::step;
    std::vector<CutCurve> curves = {};
};

namespace detail {

template <brep B>
class CutFinder {
public:
    CutFinder(const B& b, SolidId solid) : b_(b), angles_(edge_angles(b, solid)) {
        for (const OrientedFace& f : b.solid_faces(solid)) {
            faces_.push_back({f, face_shape(b, f)});
            for_each_edge_point(b, f.face, [&](const Vec3& x) { points_.push_back(x); });
            for (const Vec2& uv : face_samples(b, f.face)) {  // inside a disc, too
                points_.push_back(b.face_point(f.face, uv));
            }
        }
        for (const Vec3& x : points_) {
            middle_ += x / static_cast<double>(points_.size());
        }
        for (const Vec3& x : points_) {
            scale_ = std::max(scale_, 2 * (x - middle_).norm());
        }
        find_axes();
    }

    [[nodiscard]] std::vector<CutCandidate> run() {
        at_blend_feet();
        at_concave_edges();
        at_junctions();
        square_round_faces();
        through_axes();
        round_holes();
        at_steps();
        between_holes();
        return std::move(result_);
    }

private:
    struct Face {
        OrientedFace face;
        FaceShape shape;
    };
    /// Cylinders on one axis.
    struct AxisGroup {
        Axis axis;
        double least = 0, most = 0;  ///< radii
        bool hollow = false;         ///< all of them
        bool cylinder = false;       ///< any of them is one
        double low = 0, high = 0;    ///< extent along the axis
    };

    [[nodiscard]] const FaceShape& shape_of(const OrientedFace& f) const {
        return std::find_if(faces_.begin(), faces_.end(), [&](const Face& own) { return own.face.face == f.face; })
            ->shape;
    }

    void find_axes() {
        for (const Face& f : faces_) {
            if (f.shape.kind != FaceKind::cylinder && f.shape.kind != FaceKind::revolved) {
                continue;
            }
            double low = 1e300;
            double high = -1e300;
            double least = 1e300;
            double most = 0;
            for_each_edge_point(b_, f.face.face, [&](const Vec3& x) {
                const double z = (x - f.shape.axis.origin).dot(f.shape.axis.direction);
                const double r = distance_to_line(x, f.shape.axis);
                low = std::min(low, z);
                high = std::max(high, z);
                least = std::min(least, r);
                most = std::max(most, r);
            });
            const bool cylinder = f.shape.kind == FaceKind::cylinder;
            const auto same =
                std::find_if(axes_.begin(), axes_.end(), [&](const AxisGroup& g) { return on_axis(f.shape, g); });
            if (same == axes_.end()) {
                axes_.push_back({f.shape.axis, least, most, f.shape.hollow, cylinder, low, high});
                continue;
            }
            const double shift = (f.shape.axis.origin - same->axis.origin).dot(same->axis.direction);
            const bool along = f.shape.axis.direction.dot(same->axis.direction) > 0;
            same->least = std::min(same->least, least);
            same->most = std::max(same->most, most);
            same->hollow = same->hollow && f.shape.hollow;
            same->cylinder = same->cylinder || cylinder;
            same->low = std::min(same->low, shift + (along ? low : -high));
            same->high = std::max(same->high, shift + (along ? high : -low));
        }
    }

    /// Whether the surface has points of the solid on both sides, with more than slivers there.
    [[nodiscard]] bool divides(const CutSurface& surface) const {
        double low = 0;
        double high = 0;
        for (const Vec3& x : points_) {
            const double d = signed_distance(surface, x);
            low = std::min(low, d);
            high = std::max(high, d);
        }
        return low < -1e-3 * scale_ && high > 1e-3 * scale_;
    }

    void add(std::vector<CutSurface> surfaces, CutReason reason) {
        std::erase_if(surfaces, [&](const CutSurface& s) { return !divides(s); });
        if (surfaces.empty()) {
            return;
        }
        const auto same = [&](const CutCandidate& other) {
            return std::is_permutation(
                surfaces.begin(), surfaces.end(), other.surfaces.begin(), other.surfaces.end(),
                [&](const CutSurface& x, const CutSurface& y) { return same_surface(x, y, 1e-5 * scale_); });
        };
        if (std::none_of(result_.begin(), result_.end(), same)) {
            result_.push_back({std::move(surfaces), reason});
        }
    }

    [[nodiscard]] Vec3 seam_at(const Vec3& x, const Axis& axis) const {
        const Vec3 arm = x - axis.origin - (x - axis.origin).dot(axis.direction) * axis.direction;
        return arm.norm() > 1e-9 * scale_ ? Vec3(arm.normalized()) : Vec3(axis.direction.unitOrthogonal());
    }

    /// What stands on \p face along \p edge, perpendicular to it.
    [[nodiscard]] std::optional<CutSurface> upright(const FaceShape& face, EdgeId edge) const {
        const auto range = b_.edge_range(edge);
        const Vec3 first = b_.edge_point(edge, range[0]);
        const std::optional<CircleArc> arc = circle_of(b_, edge);
        if (face.kind == FaceKind::plane) {
            const Vec3& n = face.axis.direction;
            if (arc && arc->axis.direction.cross(n).norm() < 1e-6) {
                return CutCylinder{arc->axis.origin, n, arc->radius, seam_at(first, {arc->axis.origin, n})};
            }
            if (is_straight(b_, edge)) {
                return CutPlane{first, (b_.edge_point(edge, range[1]) - first).normalized().cross(n).normalized()};
            }
        }
        if (face.kind == FaceKind::cylinder) {
            const Vec3& a = face.axis.direction;
            if (arc && arc->axis.direction.cross(a).norm() < 1e-6) {
                return CutPlane{first, a};
            }
            if (is_straight(b_, edge)) {
                return CutPlane{first, a.cross(seam_at(first, face.axis)).normalized()};
            }
        }
        return std::nullopt;
    }

    /// The face that a smooth edge leads to rises above the other.
    [[nodiscard]] bool rises(const OrientedFace& blend, const OrientedFace& from, EdgeId edge) const {
        const auto range = b_.edge_range(edge);
        const Vec3 x = b_.edge_point(edge, 0.5 * (range[0] + range[1]));
        const Vec3 n = outward_normal(b_, from, b_.closest_on_face(from.face, x));
        double least = 1e300;
        Vec3 other = x;
        for (const EdgeAngle& angle : angles_) {
            if (angle.edge == edge || (angle.faces[0].face != blend.face && angle.faces[1].face != blend.face)) {
                continue;
            }
            const auto own = b_.edge_range(angle.edge);
            for (const double part : {0.25, 0.5, 0.75}) {
                const Vec3 y = b_.edge_point(angle.edge, own[0] + part * (own[1] - own[0]));
                const double lean = std::abs((y - x).dot(b_.edge_derivative(edge, 0.5 * (range[0] + range[1]))));
                if (lean < least) {
                    least = lean;
                    other = y;
                }
            }
        }
        return (other - x).dot(n) > 1e-6 * scale_;
    }

    void at_blend_feet() {
        for (const EdgeAngle& angle : angles_) {
            for (std::size_t k = 0; angle.smooth() && k < 2; ++k) {
                const FaceShape& foot = shape_of(angle.faces[k]);
                const bool curved = shape_of(angle.faces[1 - k]).kind != FaceKind::plane;
                if (curved && rises(angle.faces[1 - k], angle.faces[k], angle.edge)) {
                    if (const auto surface = upright(foot, angle.edge)) {
                        add({*surface}, CutReason::blend_foot);
                    }
                }
            }
        }
    }

    void at_concave_edges() {
        for (const EdgeAngle& angle : angles_) {
            for (std::size_t k = 0; angle.concave() && k < 2; ++k) {
                if (const auto surface = extended(shape_of(angle.faces[k]), angle.edge)) {
                    add({*surface}, CutReason::concave_edge);
                }
            }
        }
    }

    [[nodiscard]] std::optional<CutSurface> extended(const FaceShape& face, EdgeId edge) const {
        if (face.kind == FaceKind::plane) {
            return CutPlane{face.axis.origin, face.axis.direction};
        }
        if (face.kind == FaceKind::cylinder) {
            const Vec3 x = b_.edge_point(edge, b_.edge_range(edge)[0]);
            return CutCylinder{face.axis.origin, face.axis.direction, face.radius, seam_at(x, face.axis)};
        }
        return std::nullopt;
    }

    /// A run whose cylinder goes on at both sides of where the axes meet, and a branch.
    void at_junctions() {
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            for (std::size_t j = i + 1; j < axes_.size(); ++j) {
                const auto meet = common_point(axes_[i].axis, axes_[j].axis, 1e-4 * scale_);
                if (!meet || !axes_[i].cylinder || !axes_[j].cylinder) {
                    continue;
                }
                for (const auto& [run, branch] : {std::pair(i, j), std::pair(j, i)}) {
                    junction(axes_[run], axes_[branch], *meet);
                }
            }
        }
    }

    void junction(const AxisGroup& run, const AxisGroup& branch, const Vec3& meet) {
        const auto [low, high] = reach(run, meet);
        const auto [low_branch, high_branch] = reach(branch, meet);
        // The branch leaves to one side of the run, which goes on to both.
        if (!(low < -1.01 * branch.least && high > 1.01 * branch.least)) {
            return;
        }
        const bool both = low_branch < -1.01 * run.least && high_branch > 1.01 * run.least;
        const double sign = high_branch > -low_branch ? 1 : -1;
        const Vec3 d = sign * branch.axis.direction;
        const Vec3 across = run.axis.direction.cross(d).normalized();
        std::vector<CutSurface> saddle;
        for (const double way : {1.0, -1.0}) {
            const Vec3 r = way * run.axis.direction;
            const Vec3 up = (r + d).normalized();
            if (both) {
                saddle.emplace_back(CutPlane{meet, up.cross(across).normalized()});
            } else {
                saddle.emplace_back(CutHalfPlane{meet, across, up});
            }
        }
        const CutPlane of_axes{meet, across};
        const CutPlane of_branch{meet, across.cross(d).normalized()};
        const CutPlane of_run{meet, across.cross(run.axis.direction).normalized()};
        if (both) {
            add({saddle[0], saddle[1]}, CutReason::junction);
            add({saddle[0], saddle[1], of_axes}, CutReason::junction);
            return;
        }
        add({saddle[0], saddle[1], of_run, of_axes}, CutReason::junction);
        add({saddle[0], saddle[1], of_axes, of_branch}, CutReason::junction);
        add({saddle[0], saddle[1], of_branch}, CutReason::junction);
        add({saddle[0], saddle[1]}, CutReason::junction);
        add({of_run, of_axes}, CutReason::junction);
    }

    /// How far a group reaches along its axis, measured from a point of that.
    [[nodiscard]] static std::pair<double, double> reach(const AxisGroup& g, const Vec3& from) {
        const double at = (from - g.axis.origin).dot(g.axis.direction);
        return {g.low - at, g.high - at};
    }

    /// Directions of the normals of plane faces and of axes, perpendicular to \p axis, most faces first.
    [[nodiscard]] std::vector<Vec3> across(const Vec3& axis) const {
        std::vector<std::pair<int, Vec3>> found;
        const auto note = [&](const Vec3& d, int weight) {
            if (std::abs(d.dot(axis)) > 1e-6 * d.norm() || !(d.norm() > 1e-9)) {
                return;
            }
            const Vec3 unit = d.normalized();
            const auto same = std::find_if(found.begin(), found.end(),
                                           [&](const auto& f) { return f.second.cross(unit).norm() < 1e-6; });
            if (same == found.end()) {
                found.emplace_back(weight, unit);
            } else {
                same->first += weight;
            }
        };
        for (const Face& f : faces_) {
            if (f.shape.kind == FaceKind::plane) {
                note(f.shape.axis.direction, 2);
                note(f.shape.axis.direction.cross(axis), 1);
            }
        }
        for (const AxisGroup& g : axes_) {
            note(g.axis.direction, 2);
            note(g.axis.direction.cross(axis), 2);
        }
        if (found.empty()) {
            found.emplace_back(1, axis.unitOrthogonal());
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first > y.first; });
        std::vector<Vec3> result;
        for (const auto& [weight, d] : found) {
            result.push_back(d);
        }
        return result;
    }

    /// Four lines on all round faces of an axis, on hollow ones alone if others are round, too.
    void square_round_faces() {
        std::vector<CutCurve> all;
        std::vector<CutCurve> hollow;
        for (const AxisGroup& g : axes_) {
            std::vector<const Face*> round;
            std::vector<FaceId> faces;
            for (const Face& f : faces_) {
                const bool revolved = f.shape.kind == FaceKind::cylinder || f.shape.kind == FaceKind::revolved;
                if (revolved && on_axis(f.shape, g) && degrees_round(b_, f.face.face, g.axis) > 100) {
                    round.push_back(&f);
                    faces.push_back(f.face.face);
                }
            }
            const Vec3 n = across(g.axis.direction).front();
            const Vec3 m = g.axis.direction.cross(n).normalized();
            for (const double azimuth : square_corners(b_, faces, g.axis, n)) {
                const double angle = azimuth * std::numbers::pi / 180;
                const Vec3 out = std::cos(angle) * n + std::sin(angle) * m;
                for (const Face* f : round) {
                    if (const auto curve = meridian(b_, f->face.face, g.axis, out, 1e-4 * scale_)) {
                        all.push_back(*curve);
                        if (f->shape.hollow) {
                            hollow.push_back(*curve);
                        }
                    }
                }
            }
        }
        if (!all.empty()) {
            result_.push_back({{}, CutReason::square, all});
        }
        if (!hollow.empty() && hollow.size() < all.size()) {
            result_.push_back({{}, CutReason::square, hollow});
        }
    }

    [[nodiscard]] bool on_axis(const FaceShape& shape, const AxisGroup& g) const {
        return g.axis.direction.cross(shape.axis.direction).norm() < 1e-6 &&
               distance_to_line(shape.axis.origin, g.axis) < 1e-5 * scale_;
    }

    void through_axes() {
        for (const AxisGroup& g : axes_) {
            const std::vector<Vec3> normals = across(g.axis.direction);
            for (std::size_t i = 0; i < std::min<std::size_t>(normals.size(), 2); ++i) {
                add({CutPlane{g.axis.origin, normals[i]}}, CutReason::axis_plane);
            }
            const Vec3 n = normals.front();
            add({CutPlane{g.axis.origin, n}, CutPlane{g.axis.origin, n.cross(g.axis.direction).normalized()}},
                CutReason::axis_plane);
        }
    }

    void round_holes() {
        for (const AxisGroup& g : axes_) {
            if (!g.hollow || !g.cylinder) {
                continue;
            }
            for (const double times : {1.5, 2.0}) {
                const double r = times * g.most;
                const std::vector<Vec3> normals = across(g.axis.direction);
                for (std::size_t i = 0; i < std::min<std::size_t>(normals.size(), 3); ++i) {
                    const Vec3& n = normals[i];
                    add({CutPlane{g.axis.origin + r * n, n}, CutPlane{g.axis.origin - r * n, n}}, CutReason::slab);
                }
            }
            const double r = 1.4 * g.most;
            const Vec3 seam = across(g.axis.direction).front();
            add({CutCylinder{g.axis.origin, g.axis.direction, r, seam}}, CutReason::round_hole);
            const Vec3 n = seam;
            const Vec3 m = n.cross(g.axis.direction).normalized();
            add({CutPlane{g.axis.origin + r * n, n}, CutPlane{g.axis.origin - r * n, n},
                 CutPlane{g.axis.origin + r * m, m}, CutPlane{g.axis.origin - r * m, m}},
                CutReason::slab);
        }
    }

    void at_steps() {
        for (const Face& f : faces_) {
            if (f.shape.kind == FaceKind::plane) {
                add({CutPlane{f.shape.axis.origin, f.shape.axis.direction}}, CutReason::step);
            }
        }
        for (const EdgeAngle& angle : angles_) {
            if (const auto arc = circle_of(b_, angle.edge)) {
                add({CutPlane{arc->axis.origin, arc->axis.direction}}, CutReason::step);
            }
        }
    }

    void between_holes() {
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            for (std::size_t j = i + 1; j < axes_.size(); ++j) {
                const Axis& a = axes_[i].axis;
                const Axis& c = axes_[j].axis;
                const Vec3 n = a.direction.cross(c.direction);
                if (!axes_[i].hollow || !axes_[j].hollow || n.norm() < 1e-3) {
                    continue;
                }
                const Vec3 unit = n.normalized();
                const double gap = (c.origin - a.origin).dot(unit);
                const double room = std::abs(gap) - axes_[i].most - axes_[j].most;
                if (room > 1e-3 * scale_) {
                    const double at = (gap > 0 ? 1 : -1) * (axes_[i].most + 0.5 * room);
                    add({CutPlane{a.origin + at * unit, unit}}, CutReason::between);
                }
            }
        }
    }

    const B& b_;
    std::vector<EdgeAngle> angles_;
    std::vector<Face> faces_;
    std::vector<AxisGroup> axes_;
    std::vector<Vec3> points_;
    Vec3 middle_ = Vec3::Zero();
    double scale_ = 0;
    std::vector<CutCandidate> result_;
};

}  // namespace detail

/// Cuts of \p solid worth a try, in the order in which they tend to help: surfaces that stand upright at the feet of
/// concave blends; planes and cylinders that go on beyond concave edges; planes through the saddles of junctions of
/// cylinders whose axes meet, as sets; lines along round faces, where a structured mesh turns; planes through axes;
/// slabs, boxes and cylinders round holes; planes of faces and circles; planes between holes of different directions.
/// Surfaces that leave the solid on one side are left out, and so is what came before. O(edges squared).
template <brep B>
[[nodiscard]] std::vector<CutCandidate> cut_candidates(const B& b, SolidId solid) {
    return detail::CutFinder<B>(b, solid).run();
}

}  // namespace pavior
