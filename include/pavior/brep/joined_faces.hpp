#pragma once
/// \file
/// Models in which faces that go on in each other are one: a cap that a cut, or the seam of a surface that is closed
/// elsewhere, splits in two.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/brep.hpp>
#include <pavior/brep/detail/face_joiner.hpp>
#include <pavior/brep/seamless.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/math/box.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Loops run the other way round.
[[nodiscard]] PAVIOR_INLINE std::vector<EdgeLoop> turned_loops(std::span<const EdgeLoop> loops);

}  // namespace detail

/// A model in which faces that go on in each other are one; models brep. Two faces are one if they share an edge that
/// no other face has, lie on one surface (within 1e-7 of their size), and bound the same solids on the same sides.
/// Faces with seams, and those that together close round a period of their surface (a whole cylinder, a dome round its
/// pole), stay apart. The first face stands for all; the others bound no solid any more, but keep their ids. Ids, tags
/// and parameters are those of the model, to which it keeps a reference; all_tags() of a joined face are those of all.
/// O(edges) evaluations of the model to make.
template <brep B>
class JoinedFaces {
public:
    explicit JoinedFaces(const B& b) : b_(b) {
        detail::FaceJoiner<B> joiner(b);
        for (const std::vector<FaceId>& group : joiner.groups()) {
            join(joiner, group);
        }
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(b.solid_count()); ++s) {
            std::vector<OrientedFace> faces;
            for (const OrientedFace& f : b.solid_faces(SolidId{s})) {
                if (whole(f.face) == f.face) {
                    faces.push_back(f);
                }
            }
            solid_faces_.push_back(std::move(faces));
        }
    }

    /// Some faces were joined.
    [[nodiscard]] bool any() const { return !groups_.empty(); }

    /// The face that stands for \p face, itself if it is not joined.
    [[nodiscard]] FaceId whole(FaceId face) const {
        const auto at = first_.find(face);
        return at == first_.end() ? face : at->second;
    }

    /// The faces that \p face stands for; empty if it is one of its own.
    [[nodiscard]] std::span<const FaceId> parts(FaceId face) const {
        const auto at = groups_.find(face);
        return at == groups_.end() ? std::span<const FaceId>{} : std::span<const FaceId>(at->second.faces);
    }

    [[nodiscard]] std::size_t vertex_count() const { return b_.vertex_count(); }
    [[nodiscard]] std::size_t edge_count() const { return b_.edge_count(); }
    [[nodiscard]] std::size_t face_count() const { return b_.face_count(); }
    [[nodiscard]] std::size_t solid_count() const { return b_.solid_count(); }
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId s) const { return solid_faces_[s.index()]; }
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId f) const {
        const auto at = groups_.find(f);
        return at == groups_.end() ? b_.face_loops(f) : std::span<const EdgeLoop>(at->second.loops);
    }
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId e) const { return b_.edge_vertices(e); }
    [[nodiscard]] Vec3 vertex_point(VertexId v) const { return b_.vertex_point(v); }
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId e) const { return b_.edge_range(e); }
    [[nodiscard]] Vec3 edge_point(EdgeId e, double t) const { return b_.edge_point(e, t); }
    [[nodiscard]] Vec3 edge_derivative(EdgeId e, double t) const { return b_.edge_derivative(e, t); }
    [[nodiscard]] double edge_length(EdgeId e) const { return b_.edge_length(e); }
    [[nodiscard]] Vec3 face_point(FaceId f, const Vec2& uv) const { return b_.face_point(f, uv); }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const {
        return b_.face_derivatives(f, uv);
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId f, const Vec3& x) const {
        const auto at = groups_.find(f);
        return at == groups_.end() ? b_.closest_on_face(f, x) : closest_in(at->second, f, x);
    }
    [[nodiscard]] Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        const auto at = groups_.find(f);
        const bool own = at == groups_.end() || std::binary_search(at->second.own.begin(), at->second.own.end(), e);
        return own ? b_.edge_on_face(e, t, f, forward) : closest_on_face(f, b_.edge_point(e, t));
    }
    [[nodiscard]] std::array<double, 2> face_period(FaceId f) const { return b_.face_period(f); }
    [[nodiscard]] int tag(int dimension, std::size_t index) const { return b_.tag(dimension, index); }
    [[nodiscard]] std::vector<int> all_tags(int dimension, std::size_t index) const {
        std::vector<int> result = pavior::all_tags(b_, dimension, index);
        if (dimension == 2) {
            for (const FaceId f : parts(FaceId{static_cast<std::int32_t>(index)})) {
                const std::vector<int> own = pavior::all_tags(b_, 2, f.index());
                result.insert(result.end(), own.begin(), own.end());
            }
        }
        return result;
    }

    /// The normals of a joined face and of one of its parts() point the same way.
    [[nodiscard]] bool same_sense(FaceId /*face*/, FaceId part) const { return turned_.find(part) == turned_.end(); }

    /// The one of parts(face) that lies nearest to \p x; \p face if it has none.
    [[nodiscard]] FaceId part_at(FaceId face, const Vec3& x) const {
        FaceId best = face;
        double least = std::numeric_limits<double>::infinity();
        const auto at = groups_.find(face);
        for (std::size_t i = 0; at != groups_.end() && i < at->second.faces.size(); ++i) {
            // Of points on one surface, that one counts as nearest whose boundary winds round it.
            if (const double turn = std::abs(winding(face, at->second.outlines[i], x)); - turn < least) {
                least = -turn;
                best = at->second.faces[i];
            }
        }
        return best;
    }

private:
    struct Group {
        std::vector<FaceId> faces;
        std::vector<EdgeLoop> loops;
        std::vector<EdgeId> own;                               ///< edges of the first face, ascending
        std::vector<std::vector<std::vector<Vec2>>> outlines;  ///< loops of each face in the parameters of the first
        std::vector<detail::SurfacePoint> anchors;             ///< points of the outlines
        double size = 0;                                       ///< diagonal of the box round the anchors
    };

    /// From the nearest anchor on: projections of points beyond the first face are slow or end at its boundary.
    [[nodiscard]] Vec2 closest_in(const Group& group, FaceId f, const Vec3& x) const {
        const auto anchor = std::min_element(group.anchors.begin(), group.anchors.end(),
                                             [&](const detail::SurfacePoint& p, const detail::SurfacePoint& q) {
                                                 return (p.x - x).squaredNorm() < (q.x - x).squaredNorm();
                                             });
        const std::optional<SurfaceFoot> foot = surface_foot(b_, f, x, anchor->uv, 1e-10 * group.size);
        if (foot && foot->distance <= 0.05 * group.size) {
            return foot->uv;
        }
        const Vec2 uv = b_.closest_on_face(f, x);
        return foot && foot->distance < (b_.face_point(f, uv) - x).norm() ? foot->uv : uv;
    }

    /// Loops of \p part, in the parameters of \p face, as polygons; empty if its surface is another.
    [[nodiscard]] std::vector<std::vector<Vec2>> outline(FaceId face, std::span<const detail::SurfacePoint> own,
                                                         FaceId part, double tolerance) const {
        constexpr int steps = 8;
        const Periods periods = b_.face_period(face);
        std::vector<std::vector<Vec2>> result;
        for (const EdgeLoop& loop : b_.face_loops(part)) {
            std::vector<Vec2> polygon;
            for (const OrientedEdge& use : loop) {
                const auto range = b_.edge_range(use.edge);
                for (int i = 0; i < steps; ++i) {
                    const double at = static_cast<double>(use.forward ? i : steps - i) / steps;
                    const double t = range[0] + at * (range[1] - range[0]);
                    const std::optional<Vec2> uv = detail::on_surface(
                        b_, face, own, {b_.edge_point(use.edge, t), b_.edge_on_face(use.edge, t, part, use.forward)},
                        tolerance);
                    if (!uv) {
                        return {};
                    }
                    const Vec2 near = polygon.empty() ? *uv : polygon.back();
                    polygon.emplace_back(*uv + nearest_image_shift(*uv, near, periods));
                }
            }
            result.push_back(std::move(polygon));
        }
        return result;
    }

    /// A loop of \p face as a polygon in its parameters.
    [[nodiscard]] std::vector<Vec2> polygon_of(const Group& group, FaceId face, const EdgeLoop& loop) const {
        constexpr int steps = 8;
        const Periods periods = b_.face_period(face);
        std::vector<Vec2> polygon;
        for (const OrientedEdge& use : loop) {
            const auto range = b_.edge_range(use.edge);
            for (int i = 0; i < steps; ++i) {
                const double at = static_cast<double>(use.forward ? i : steps - i) / steps;
                const Vec2 uv = closest_in(group, face, b_.edge_point(use.edge, range[0] + at * (range[1] - range[0])));
                polygon.emplace_back(uv + nearest_image_shift(uv, polygon.empty() ? uv : polygon.back(), periods));
            }
        }
        return polygon;
    }

    /// The angle by which an outline winds round \p x, in the parameters of \p face.
    [[nodiscard]] double winding(FaceId face, const std::vector<std::vector<Vec2>>& outline, const Vec3& x) const {
        const Vec2 at = closest_on_face(face, x);
        const Periods periods = b_.face_period(face);
        double sum = 0;
        for (const std::vector<Vec2>& polygon : outline) {
            const Vec2 shift = nearest_image_shift(polygon.front(), at, periods);
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Vec2 a = polygon[i] + shift - at;
                const Vec2 c = polygon[(i + 1) % polygon.size()] + shift - at;
                sum += std::atan2(a[0] * c[1] - a[1] * c[0], a.dot(c));
            }
        }
        return sum;
    }

    /// Twice the area of a polygon, 0 if it does not close because it runs round a period.
    [[nodiscard]] static double area(const std::vector<Vec2>& polygon, const Periods& periods) {
        if (nearest_image_shift(polygon.front(), polygon.back(), periods).norm() > 0) {
            return 0;
        }
        double twice = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 a = polygon[i] - polygon.front();
            const Vec2 c = polygon[(i + 1) % polygon.size()] - polygon.front();
            twice += a[0] * c[1] - a[1] * c[0];
        }
        return twice;
    }

    void join(const detail::FaceJoiner<B>& joiner, const std::vector<FaceId>& faces) {
        const FaceId first = faces.front();
        Group group{faces, {}, {}, {}, {}, 0};
        std::vector<EdgeLoop> loops;
        std::set<FaceId> turned;
        for (const FaceId f : faces) {
            const detail::Joint joint = f == first ? detail::Joint::same : joiner.joint(first, f);
            std::vector<EdgeLoop> own(b_.face_loops(f).begin(), b_.face_loops(f).end());
            if (joint == detail::Joint::turned) {
                own = detail::turned_loops(own);
                turned.insert(f);
            }
            if (joint == detail::Joint::none || !add_outline(f, group)) {
                return;
            }
            loops.insert(loops.end(), own.begin(), own.end());
        }
        for (const EdgeLoop& loop : b_.face_loops(first)) {
            for (const OrientedEdge& use : loop) {
                group.own.push_back(use.edge);
            }
        }
        std::sort(group.own.begin(), group.own.end());
        if (!set_loops(seamless_loops(loops), group)) {
            return;
        }
        for (const FaceId f : faces) {
            first_[f] = first;
        }
        turned_.insert(turned.begin(), turned.end());
        groups_[first] = std::move(group);
    }

    /// Adds the outline of \p f and its points; false if it is not on the surface of the first face of the group.
    bool add_outline(FaceId f, Group& group) const {
        const FaceId first = group.faces.front();
        const std::vector<detail::SurfacePoint> own = detail::surface_points(b_, first);
        Box<Vec3> box;
        for (const detail::SurfacePoint& p : own) {
            box.add(p.x);
        }
        group.outlines.push_back(outline(first, own, f, 1e-6 * box.diagonal()));
        for (const std::vector<Vec2>& polygon : group.outlines.back()) {
            for (const Vec2& uv : polygon) {
                group.anchors.push_back({b_.face_point(first, uv), uv});
            }
        }
        group.size = std::max(group.size, box.diagonal());
        return !group.outlines.back().empty();
    }

    /// Sets the loops of the whole, the outer one first; false if there is none, or one runs round a period.
    [[nodiscard]] bool set_loops(std::vector<EdgeLoop> loops, Group& group) const {
        const Periods periods = b_.face_period(group.faces.front());
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            order.emplace_back(-std::abs(area(polygon_of(group, group.faces.front(), loops[l]), periods)), l);
        }
        std::sort(order.begin(), order.end());
        for (const auto& [size, l] : order) {
            if (size == 0) {
                return false;
            }
            group.loops.push_back(std::move(loops[l]));
        }
        return !loops.empty();
    }

    const B& b_;
    std::map<FaceId, FaceId> first_;  ///< of joined faces: the one that stands for them
    std::map<FaceId, Group> groups_;  ///< by that one
    std::set<FaceId> turned_;         ///< parts whose normals point the other way
    std::vector<std::vector<OrientedFace>> solid_faces_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/joined_faces-inl.hpp>
#endif
