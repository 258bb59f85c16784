#pragma once
/// \file
/// Solids of a CAD model that are extrusions, as an extruded body.

#include <pavior/brep/all_tags.hpp>
#include <pavior/core/error.hpp>
#include <pavior/many_to_many/extruded_body.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/local_sizes.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// The body of some solids along one direction, and its geometry; a view of the model. Models extruded_geometry.
template <brep B>
class BrepBody {
public:
    /// \p chord, \p spacing: largest chord error and largest distance of the points of the polylines. Solid i of the
    /// body is solids[i].
    /// \throws UnmeshableError not_sweepable where \p extrusion has refusals, or an edge between two sides turns back
    BrepBody(const B& b, std::span<const SolidId> solids, const Extrusion& extrusion, double chord, double spacing,
             const LocalSizes& sizes = {})
        : b_(b),
          chord_(chord),
          spacing_(spacing),
          sizes_(sizes),
          lean_(std::max(extrusion.side_tolerance, 1e-3)),
          vertex_(b.vertex_count(), no_index),
          curve_(b.edge_count(), no_index),
          curve_size_(b.edge_count()) {
        if (!extrusion.possible()) {
            throw extrusion_error(b, extrusion);
        }
        make_frame(extrusion.direction);
        for (std::size_t s = 0; s < solids.size(); ++s) {
            for (const OrientedFace& f : b.solid_faces(solids[s])) {
                add_edge_sizes(f.face, solids[s]);
                add_face(f, static_cast<Index>(s), extrusion.roles[f.face.index()]);
            }
        }
        for (std::size_t c = 0; c < edges_.size(); ++c) {
            const auto size = sizes_.edge.find(body_.curves[c].tag);
            body_.curves[c].size = size != sizes_.edge.end() ? size->second : curve_size_[edges_[c].index()].smallest();
        }
        find_planes();
    }

    [[nodiscard]] const ExtrudedBody& body() const { return body_; }
    [[nodiscard]] FaceId cap_face(Index cap) const { return caps_[cap]; }
    [[nodiscard]] FaceId side_face(Index side) const { return sides_[side]; }

    [[nodiscard]] Vec3 curve_point(Index curve, const Vec2& near) const {
        const std::span<const Vec2> line = body_.plane[curve];
        const std::vector<double>& t = parameters_[curve];
        double best = std::numeric_limits<double>::infinity();
        double at = t.front();
        std::size_t piece = 0;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const Vec2 along = line[i + 1] - line[i];
            const double s = std::clamp((near - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
            const double distance = (line[i] + s * along - near).squaredNorm();
            if (distance < best) {
                best = distance;
                piece = i;
                at = (1 - s) * t[i] + s * t[i + 1];
            }
        }
        return closest(edges_[curve], near, at, t[piece == 0 ? 0 : piece - 1], t[std::min(piece + 2, t.size() - 1)]);
    }

    [[nodiscard]] double cap_height(Index cap, const Vec2& at) const {
        if (const auto& plane = planes_[cap]) {
            return (*plane)[0] + (*plane)[1] * at[0] + (*plane)[2] * at[1];
        }
        const FaceId face = caps_[cap];
        Vec3 guess(at[0], at[1], middle_[cap]);
        Vec2 uv = b_.closest_on_face(face, body_.frame.to_space(guess));
        for (int i = 0; i < 20; ++i) {
            const Vec3 x = body_.frame.to_frame(b_.face_point(face, uv));
            const Vec2 miss = at - x.head<2>();
            guess = x;
            if (miss.norm() <= 1e-13 * (1 + at.norm())) {
                break;
            }
            const auto [du, dv] = b_.face_derivatives(face, uv);
            const Vec3 a = body_.frame.to_frame(du);
            const Vec3 c = body_.frame.to_frame(dv);
            const double det = a[0] * c[1] - a[1] * c[0];
            if (!(std::abs(det) > 0)) {
                break;
            }
            uv += Vec2(miss[0] * c[1] - miss[1] * c[0], a[0] * miss[1] - a[1] * miss[0]) / det;
        }
        return guess[2];
    }

private:
    struct Smallest {
        double face = 0, solid = 0;
        [[nodiscard]] double smallest() const { return face > 0 ? face : solid; }
    };

    /// The point of an edge next to `near` in the plane, parameter in [low, high]: Newton's method (without the second
    /// derivative), bisection where it leaves the bracket or does not halve the slope of the distance.
    [[nodiscard]] Vec3 closest(EdgeId edge, const Vec2& near, double at, double low, double high) const {
        const double width = high - low;
        double last = std::numeric_limits<double>::infinity();
        Vec3 x = body_.frame.to_frame(b_.edge_point(edge, at));
        for (int i = 0; i < 60 && high - low > 1e-15 * width; ++i) {
            const Vec2 along = body_.frame.to_frame(b_.edge_derivative(edge, at)).template head<2>();
            const double slope = (x.template head<2>() - near).dot(along);
            (slope > 0 ? high : low) = at;
            const double newton = at - slope / along.squaredNorm();
            const bool good = newton >= low && newton <= high && std::abs(slope) <= 0.5 * last;
            const double next = good ? newton : 0.5 * (low + high);
            last = std::abs(slope);
            if (std::abs(next - at) <= 1e-15 * width) {
                break;
            }
            at = next;
            x = body_.frame.to_frame(b_.edge_point(edge, at));
        }
        return x;
    }

    /// Along an axis of space, the other two are the axes of the plane.
    void make_frame(const Vec3& direction) {
        Vec3 x = direction.unitOrthogonal();
        for (int k = 0; k < 3; ++k) {
            if (direction == Vec3::Unit(k)) {
                x = Vec3::Unit((k + 1) % 3);
            }
        }
        body_.frame = {x, direction.cross(x), direction};
    }

    void add_edge_sizes(FaceId face, SolidId solid) {
        const std::optional<double> of_face = size_by_tag(b_, 2, face.index(), sizes_.face);
        const std::optional<double> of_solid = size_by_tag(b_, 3, solid.index(), sizes_.solid);
        const auto take = [](double& size, double other) { size = size > 0 ? std::min(size, other) : other; };
        for (const EdgeLoop& loop : b_.face_loops(face)) {
            for (const OrientedEdge& use : loop) {
                if (of_face) {
                    take(curve_size_[use.edge.index()].face, *of_face);
                }
                if (of_solid) {
                    take(curve_size_[use.edge.index()].solid, *of_solid);
                }
            }
        }
    }

    void add_face(const OrientedFace& f, Index solid, ExtrusionRole role) {
        const bool side = role == ExtrusionRole::side;
        std::vector<FaceId>& list = side ? sides_ : caps_;
        const auto found = std::find(list.begin(), list.end(), f.face);
        const auto at = static_cast<std::size_t>(found - list.begin());
        if (found == list.end()) {
            list.push_back(f.face);
            std::vector<Index> curves;
            for (const EdgeLoop& loop : b_.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    if (const Index c = curve(use.edge, f.face, side); c != no_index) {
                        curves.push_back(c);
                    }
                }
            }
            const int tag = b_.tag(2, f.face.index());
            if (side) {
                body_.sides.push_back({std::move(curves), tag});
            } else {
                body_.caps.push_back({std::move(curves), no_index, no_index, tag});
            }
        }
        if (!side) {
            const Vec3 normal = detail::face_normals(b_, f.face).front();
            const bool up = (normal.dot(body_.frame.direction) > 0) == f.outward;
            (up ? body_.caps[at].below : body_.caps[at].above) = solid;
        }
    }

    Index vertex(VertexId v) {
        Index& at = vertex_[v.index()];
        if (at == no_index) {
            at = static_cast<Index>(body_.vertices.size());
            body_.vertices.push_back(body_.frame.to_frame(b_.vertex_point(v)));
        }
        return at;
    }

    /// The curve of an edge, no_index for one along the direction.
    Index curve(EdgeId edge, FaceId face, bool side) {
        Index& at = curve_[edge.index()];
        if (at != no_index) {
            return at;
        }
        std::vector<double> t = sample(edge);
        std::vector<Vec2> line;
        double length = 0;
        for (const double s : t) {
            const Vec3 x = body_.frame.to_frame(b_.edge_point(edge, s));
            length += line.empty() ? 0.0 : (x.head<2>() - line.back()).norm();
            line.emplace_back(x.head<2>());
        }
        if (side && length <= lean_ * b_.edge_length(edge)) {
            return no_index;
        }
        for (std::size_t i = 0; side && i + 2 < line.size(); ++i) {
            if ((line[i + 1] - line[i]).dot(line[i + 2] - line[i + 1]) <= 0) {
                const int tag = b_.tag(2, face.index());
                throw UnmeshableError(ErrorCode::not_sweepable,
                                      "face " + std::to_string(tag) + ": its edge " +
                                          std::to_string(b_.tag(1, edge.index())) +
                                          " turns back seen along the direction",
                                      {tag});
            }
        }
        at = static_cast<Index>(edges_.size());
        const auto ends = b_.edge_vertices(edge);
        line.front() = body_.frame.to_frame(b_.vertex_point(ends[0])).template head<2>();
        line.back() = body_.frame.to_frame(b_.vertex_point(ends[1])).template head<2>();
        body_.curves.push_back({{vertex(ends[0]), vertex(ends[1])}, 0, b_.tag(1, edge.index())});
        body_.plane.add(line);
        edges_.push_back(edge);
        parameters_.push_back(std::move(t));
        return at;
    }

    /// Parameters whose points, joined by lines, keep to the curve within the chord error, and to the spacing.
    [[nodiscard]] std::vector<double> sample(EdgeId edge) const {
        constexpr std::size_t most = 4096;
        const auto range = b_.edge_range(edge);
        const auto plane = [&](double t) {
            return Vec2(body_.frame.to_frame(b_.edge_point(edge, t)).template head<2>());
        };
        const auto split = [&](std::size_t n) {
            std::vector<double> t;
            for (std::size_t i = 0; i <= n; ++i) {
                t.push_back(i == n
                                ? range[1]
                                : range[0] + (range[1] - range[0]) * static_cast<double>(i) / static_cast<double>(n));
            }
            return t;
        };
        const Vec2 a = plane(range[0]);
        const Vec2 d = plane(range[1]) - a;
        const double scale = d.norm() + b_.edge_length(edge);
        const auto off_line = [&](double t) {
            const Vec2 x = plane(t) - a;
            return std::abs(x[0] * d[1] - x[1] * d[0]) > 1e-9 * d.norm() * scale;
        };
        const double pieces = std::ceil(b_.edge_length(edge) / spacing_);
        const auto least = static_cast<std::size_t>(std::clamp(pieces, 1.0, static_cast<double>(most)));
        const std::vector<double> probe = split(7);
        if (d.norm() > 1e-6 * scale && std::none_of(probe.begin() + 1, probe.end() - 1, off_line)) {
            return split(least);
        }
        std::size_t n = std::max<std::size_t>(8, least);
        for (; n < most; n *= 2) {
            const std::vector<double> t = split(n);
            double worst = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const Vec2 chord_middle = 0.5 * (plane(t[i]) + plane(t[i + 1]));
                worst = std::max(worst, (plane(0.5 * (t[i] + t[i + 1])) - chord_middle).norm());
            }
            if (worst <= chord_) {
                break;
            }
        }
        return split(n);
    }

    /// Caps that are planes get an equation: height = p0 + p1 x + p2 y.
    void find_planes() {
        for (const FaceId f : caps_) {
            const std::vector<Vec3> normals = detail::face_normals(b_, f);
            const std::vector<Vec2> samples = detail::face_samples(b_, f);
            const Vec3 n = body_.frame.to_frame(normals.front());
            const Vec3 x = body_.frame.to_frame(b_.face_point(f, samples.front()));
            std::optional<Vec3> plane(Vec3(x[2] + (n[0] * x[0] + n[1] * x[1]) / n[2], -n[0] / n[2], -n[1] / n[2]));
            double sum = 0;
            double scale = 0;
            for (const Vec2& uv : samples) {
                const Vec3 y = body_.frame.to_frame(b_.face_point(f, uv));
                sum += y[2];
                scale = std::max(scale, (y - x).norm());
            }
            for (std::size_t i = 0; plane && i < samples.size(); ++i) {
                const Vec3 y = body_.frame.to_frame(b_.face_point(f, samples[i]));
                if (std::abs((*plane)[0] + (*plane)[1] * y[0] + (*plane)[2] * y[1] - y[2]) > 1e-9 * scale) {
                    plane.reset();
                }
            }
            if (plane && plane->tail<2>().norm() < 1e-9) {
                *plane = {x[2], 0, 0};
            }
            planes_.push_back(plane);
            middle_.push_back(sum / static_cast<double>(samples.size()));
        }
    }

    const B& b_;
    double chord_, spacing_;
    LocalSizes sizes_;
    double lean_;  ///< of an edge along the direction at most, sine of the angle
    ExtrudedBody body_;
    std::vector<Index> vertex_, curve_;
    std::vector<Smallest> curve_size_;  ///< by edge id
    std::vector<EdgeId> edges_;         ///< of the curves
    std::vector<std::vector<double>> parameters_;
    std::vector<FaceId> caps_, sides_;
    std::vector<std::optional<Vec3>> planes_;
    std::vector<double> middle_;
};

}  // namespace pavior
