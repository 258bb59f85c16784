#pragma once
/// \file
/// Models in which faces that go on in each other are one: a cap that a cut, or the seam of a surface that is closed
/// elsewhere, splits in two.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/brep.hpp>
#include <pavior/brep/seamless.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/disjoint_sets.hpp>
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

/// Parameters of the point of the surface of \p face next to \p x, also beyond the face, where closest_on_face() may
/// end: they may be those of one of \p others, faces on the same surface.
template <brep B>
[[nodiscard]] Vec2 closest_on_surface(const B& b, FaceId face, const Vec3& x, std::span<const FaceId> others = {}) {
    const auto off = [&](const Vec2& uv) { return (b.face_point(face, uv) - x).norm(); };
    Vec2 best = b.closest_on_face(face, x);
    double least = off(best);
    for (const FaceId other : others) {
        const Vec2 uv = other == face ? best : b.closest_on_face(other, x);
        if (const double own = off(uv); own < least) {
            least = own;
            best = uv;
        }
    }
    const std::optional<SurfaceFoot> foot = least > 0 ? surface_foot(b, face, x, best, 1e-8 * least) : std::nullopt;
    return foot && foot->distance < least ? foot->uv : best;
}

/// The joints of faces of a model: which pairs go on in each other.
template <brep B>
class FaceJoiner {
public:
    explicit FaceJoiner(const B& b) : b_(b), owners_(b.face_count()), faces_(b.edge_count()), sets_(b.face_count()) {
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(b.solid_count()); ++s) {
            for (const OrientedFace& f : b.solid_faces(SolidId{s})) {
                owners_[f.face.index()].emplace_back(SolidId{s}, f.outward);
            }
        }
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(b.face_count()); ++f) {
            for (const EdgeLoop& loop : b.face_loops(FaceId{f})) {
                for (const OrientedEdge& use : loop) {
                    faces_[use.edge.index()].push_back(FaceId{f});
                }
            }
        }
        for (const std::vector<FaceId>& pair : faces_) {
            if (pair.size() == 2 && pair[0] != pair[1] && !sets_.same(pair[0].index(), pair[1].index()) &&
                joint(pair[0], pair[1])) {
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

    /// The normals of two faces on one surface point the same way.
    [[nodiscard]] bool same_sense(FaceId f, FaceId g) const {
        const Vec3 x = samples(g).front();
        return normal(f, x, g).dot(normal(g, x, g)) > 0;
    }

    /// Points on the edges of a face.
    [[nodiscard]] std::vector<Vec3> samples(FaceId f) const {
        std::vector<Vec3> result;
        for (const EdgeLoop& loop : b_.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                const auto range = b_.edge_range(use.edge);
                for (const double part : {0.0, 0.27, 0.5, 0.81}) {
                    result.push_back(b_.edge_point(use.edge, range[0] + part * (range[1] - range[0])));
                }
            }
        }
        const std::size_t n = result.size();
        for (std::size_t i = 0; i < n; i += 3) {  // and some inside
            const Vec2 uv = closest_on_surface(b_, f, 0.5 * (result[i] + result[(i + n / 2) % n]));
            result.push_back(b_.face_point(f, uv));
        }
        return result;
    }

private:
    /// Of the surface of \p f at \p x, a point of \p g.
    [[nodiscard]] Vec3 normal(FaceId f, const Vec3& x, FaceId g) const {
        const auto [du, dv] = b_.face_derivatives(f, closest_on_surface(b_, f, x, std::array{g}));
        return du.cross(dv).stableNormalized();
    }

    /// All of \p g lies on the surface of \p f, with the same normals but for one sign.
    [[nodiscard]] bool continues(FaceId f, FaceId g) const {
        Box<Vec3> box;
        const std::vector<Vec3> points = samples(g);
        for (const Vec3& x : points) {
            box.add(x);
        }
        std::optional<bool> along;
        return std::all_of(points.begin(), points.end(), [&](const Vec3& x) {
            const double cosine = normal(f, x, g).dot(normal(g, x, g));
            along = along.value_or(cosine > 0);
            return (b_.face_point(f, closest_on_surface(b_, f, x, std::array{g})) - x).norm() <=
                       1e-7 * box.diagonal() &&
                   (*along ? cosine : -cosine) > 1 - 1e-7;
        });
    }

    [[nodiscard]] bool joint(FaceId f, FaceId g) const {
        const auto& of_f = owners_[f.index()];
        const auto& of_g = owners_[g.index()];
        if (of_f.empty() || of_f.size() != of_g.size() || has_seam(b_, f) || has_seam(b_, g) || !continues(f, g) ||
            !continues(g, f)) {
            return false;
        }
        const bool same = same_sense(f, g);
        return std::all_of(of_f.begin(), of_f.end(), [&](const auto& owner) {
            return std::find(of_g.begin(), of_g.end(), std::pair(owner.first, owner.second == same)) != of_g.end();
        });
    }

    const B& b_;
    std::vector<std::vector<std::pair<SolidId, bool>>> owners_;  ///< of each face
    std::vector<std::vector<FaceId>> faces_;                     ///< at each edge, one entry a use
    DisjointSets<std::size_t> sets_;
};

}  // namespace detail

/// A model in which faces that go on in each other are one; models brep. Two faces are one if they share an edge that no
/// other face has, lie on one surface (within 1e-7 of their size), and bound the same solids on the same sides. Faces
/// with seams, and those that together close round a period of their surface (a whole cylinder, a dome round its pole),
/// stay apart. The first face stands for all; the others bound no solid any more, but keep their ids. Ids, tags and
/// parameters are those of the model, to which it keeps a reference; all_tags() of a joined face are those of all.
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
        std::vector<std::pair<Vec3, Vec2>> anchors;            ///< points of the outlines, with parameters
        double size = 0;                                       ///< diagonal of the box round the anchors
    };

    /// From the nearest anchor on: projections of points beyond the first face are slow or end at its boundary.
    [[nodiscard]] Vec2 closest_in(const Group& group, FaceId f, const Vec3& x) const {
        const auto nearer = [&](const auto& p, const auto& q) {
            return (p.first - x).squaredNorm() < (q.first - x).squaredNorm();
        };
        const auto anchor = std::min_element(group.anchors.begin(), group.anchors.end(), nearer);
        const std::optional<SurfaceFoot> foot = surface_foot(b_, f, x, anchor->second, 1e-10 * group.size);
        if (foot && foot->distance <= 0.05 * group.size) {
            return foot->uv;
        }
        const Vec2 uv = detail::closest_on_surface(b_, f, x, group.faces);
        return foot && foot->distance < (b_.face_point(f, uv) - x).norm() ? foot->uv : uv;
    }

    /// Loops in the parameters of the first of \p faces, which are one, as polygons.
    [[nodiscard]] std::vector<std::vector<Vec2>> polygons(std::span<const FaceId> faces,
                                                          std::span<const EdgeLoop> loops) const {
        constexpr int steps = 8;
        const Periods periods = b_.face_period(faces.front());
        std::vector<std::vector<Vec2>> result;
        for (const EdgeLoop& loop : loops) {
            std::vector<Vec2> polygon;
            for (const OrientedEdge& use : loop) {
                const auto range = b_.edge_range(use.edge);
                for (int i = 0; i < steps; ++i) {
                    const double part = static_cast<double>(use.forward ? i : steps - i) / steps;
                    Vec2 uv = detail::closest_on_surface(
                        b_, faces.front(), b_.edge_point(use.edge, range[0] + part * (range[1] - range[0])), faces);
                    const Vec2 reference = polygon.empty() ? uv : polygon.back();
                    uv += nearest_image_shift(uv, reference, periods);
                    polygon.push_back(uv);
                }
            }
            result.push_back(std::move(polygon));
        }
        return result;
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
        const Vec2 last = polygon.front() + nearest_image_shift(polygon.front(), polygon.back(), periods);
        if ((last - polygon.front()).norm() > 0) {
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
        Group group{faces, {}, {}, {}, {}, 0};
        std::vector<EdgeLoop> loops;
        for (const FaceId f : faces) {
            const std::span<const EdgeLoop> own = b_.face_loops(f);
            if (joiner.same_sense(faces.front(), f)) {
                loops.insert(loops.end(), own.begin(), own.end());
            } else {
                const std::vector<EdgeLoop> turned = detail::turned_loops(own);
                loops.insert(loops.end(), turned.begin(), turned.end());
                turned_.insert(f);
            }
        }
        for (const EdgeLoop& loop : b_.face_loops(faces.front())) {
            for (const OrientedEdge& use : loop) {
                group.own.push_back(use.edge);
            }
        }
        std::sort(group.own.begin(), group.own.end());
        group.loops = seamless_loops(loops);
        const Periods periods = b_.face_period(faces.front());
        std::vector<std::pair<double, std::size_t>> order;
        const auto polygons_of = polygons(faces, group.loops);
        for (std::size_t l = 0; l < polygons_of.size(); ++l) {
            order.emplace_back(-std::abs(area(polygons_of[l], periods)), l);
        }
        std::sort(order.begin(), order.end());
        if (group.loops.empty() ||
            std::any_of(order.begin(), order.end(), [](const auto& entry) { return entry.first == 0; })) {
            return;
        }
        std::vector<EdgeLoop> sorted;
        for (const auto& [size, l] : order) {
            sorted.push_back(std::move(group.loops[l]));
        }
        group.loops = std::move(sorted);
        for (const FaceId f : faces) {
            first_[f] = faces.front();
            group.outlines.push_back(polygons(faces, b_.face_loops(f)));
        }
        Box<Vec3> box;
        for (const auto& outline : group.outlines) {
            for (const std::vector<Vec2>& polygon : outline) {
                for (const Vec2& uv : polygon) {
                    group.anchors.emplace_back(b_.face_point(faces.front(), uv), uv);
                    box.add(group.anchors.back().first);
                }
            }
        }
        group.size = box.diagonal();
        groups_[faces.front()] = std::move(group);
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
