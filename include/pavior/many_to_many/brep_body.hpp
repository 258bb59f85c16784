#pragma once
/// \file
/// Solids of a CAD model that are extrusions, as an extruded body.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/core/error.hpp>
#include <pavior/many_to_many/detail/given_lines.hpp>
#include <pavior/many_to_many/extruded_body.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/local_sizes.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pavior {

/// The body of some solids along one direction, and its geometry; a view of the model. Models extruded_geometry.
template <brep B>
class BrepBody {
public:
    /// \p chord, \p spacing: largest chord error and largest distance of the points of the polylines. Solid i of the
    /// body is solids[i]. The mesh of the faces and edges that \p given holds (neighbour_boundary(); null: none)
    /// becomes part of the body; it is kept by reference only while the body is made.
    /// \throws UnmeshableError not_sweepable where \p extrusion has refusals, an edge between two sides turns back, or
    /// the given mesh of a side is no grid along the direction
    BrepBody(const B& b, std::span<const SolidId> solids, const Extrusion& extrusion, double chord, double spacing,
             const LocalSizes& sizes = {}, const BoundaryMesh* given = nullptr)
        : b_(b),
          given_(given),
          chord_(chord),
          spacing_(spacing),
          sizes_(sizes),
          lean_(std::max(extrusion.side_tolerance, 1e-3)),
          vertex_(b.vertex_count(), no_index),
          pieces_(b.edge_count()),
          is_rib_(b.edge_count(), 0),
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
            if (!edges_[c].valid()) {
                continue;
            }
            const auto size = sizes_.edge.find(body_.curves[c].tag);
            body_.curves[c].size = size != sizes_.edge.end() ? size->second : curve_size_[edges_[c].index()].smallest();
        }
        find_planes();
    }

    [[nodiscard]] const ExtrudedBody& body() const { return body_; }
    [[nodiscard]] FaceId cap_face(Index cap) const { return caps_[cap]; }
    [[nodiscard]] FaceId side_face(Index side) const { return sides_[side]; }

    [[nodiscard]] Vec3 curve_point(Index curve, const Vec2& near) const {
        if (!edges_[curve].valid()) {
            return straight_point(curve, near);
        }
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
    /// The curves of an edge: one, or one between each two given nodes.
    struct Pieces {
        Index first = no_index, count = 0;
    };

    struct Smallest {
        double face = 0, solid = 0;
        [[nodiscard]] double smallest() const { return face > 0 ? face : solid; }
    };

    /// The point of a line of a given mesh next to `near` in the plane.
    [[nodiscard]] Vec3 straight_point(Index curve, const Vec2& near) const {
        const Vec3& a = body_.vertices[body_.curves[curve].vertices[0]];
        const Vec3 along = body_.vertices[body_.curves[curve].vertices[1]] - a;
        const double length = along.head<2>().squaredNorm();
        const double t = length > 0 ? (near - a.head<2>()).dot(along.head<2>()) / length : 0.0;
        return a + std::clamp(t, 0.0, 1.0) * along;
    }

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
                    const Pieces pieces = curve(use.edge, f.face, side);
                    for (Index i = 0; i < pieces.count; ++i) {
                        curves.push_back(pieces.first + i);
                    }
                }
            }
            const int tag = b_.tag(2, f.face.index());
            add_given_face(f.face, side, curves);
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

    /// The mesh that is given on an edge; null if there is none.
    [[nodiscard]] const EdgeNodes* given_edge(EdgeId edge) const {
        const bool any = given_ != nullptr && !given_->edges.empty() && !given_->edges[edge.index()].nodes.empty();
        return any ? &given_->edges[edge.index()] : nullptr;
    }

    /// The vertex of a given node at \p point of the model.
    Index given_vertex(Index node, const Vec3& point) {
        const auto [at, added] = given_vertex_.try_emplace(node, static_cast<Index>(body_.vertices.size()));
        if (added) {
            body_.vertices.push_back(body_.frame.to_frame(point));
        }
        return at->second;
    }

    /// The vertices of the given nodes of an edge; its ends are vertices of the model.
    std::vector<Index> given_vertices(EdgeId edge, const EdgeNodes& given) {
        const auto ends = b_.edge_vertices(edge);
        std::vector<Index> result;
        for (std::size_t i = 0; i < given.nodes.size(); ++i) {
            if (i == 0 || i + 1 == given.nodes.size()) {
                const Index end = vertex(ends[i == 0 ? 0 : 1]);
                given_vertex_.try_emplace(given.nodes[i], end);
                result.push_back(end);
            } else {
                result.push_back(given_vertex(given.nodes[i], b_.edge_point(edge, given.parameters[i])));
            }
        }
        return result;
    }

    /// An edge along the direction, between sides: the layers at its given nodes.
    void add_rib(EdgeId edge, FaceId face) {
        const EdgeNodes* given = given_edge(edge);
        if (given == nullptr || is_rib_[edge.index()] != 0) {
            return;
        }
        is_rib_[edge.index()] = 1;
        ExtrudedRib rib{given_vertices(edge, *given)};
        if (body_.vertices[rib.vertices.front()][2] > body_.vertices[rib.vertices.back()][2]) {
            std::reverse(rib.vertices.begin(), rib.vertices.end());
        }
        for (std::size_t i = 0; i + 1 < rib.vertices.size(); ++i) {
            body_.steps.push_back({rib.vertices[i], rib.vertices[i + 1], b_.tag(2, face.index())});
        }
        body_.ribs.push_back(std::move(rib));
    }

    /// The lines of a given mesh inside a face, whose edges are done. \p curves: those of its boundary.
    void add_given_face(FaceId face, bool side, std::vector<Index>& curves) {
        if (given_ == nullptr || given_->faces.empty() || given_->faces[face.index()].empty()) {
            return;
        }
        const int tag = b_.tag(2, face.index());
        const FaceMesh& mesh = given_->faces[face.index()];
        std::vector<Index> at;
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            at.push_back(given_vertex(mesh.nodes[i], b_.face_point(face, mesh.uv[i])));
            points.push_back(body_.vertices[at.back()]);
        }
        if (side && !detail::is_upright_grid(points, mesh.quads)) {
            throw UnmeshableError(ErrorCode::not_sweepable,
                                  "face " + std::to_string(tag) +
                                      " is a side here, yet the mesh that its neighbour made of it is no grid along "
                                      "the direction",
                                  {tag});
        }
        for (const auto& [i, k] : detail::lines_inside(b_, *given_, face)) {
            if (side && detail::is_upright(points[i], points[k])) {
                const bool up = points[k][2] > points[i][2];
                body_.steps.push_back({at[up ? i : k], at[up ? k : i], tag});
                continue;
            }
            if (!side) {
                curves.insert(curves.end(), 2, static_cast<Index>(edges_.size()));
            }
            body_.curves.push_back({{at[i], at[k]}, 0, 0, true, tag});
            body_.plane.add(std::array{Vec2(points[i].template head<2>()), Vec2(points[k].template head<2>())});
            edges_.push_back({});
            parameters_.push_back({0, 1});
        }
    }

    /// The curves of an edge, none for one along the direction.
    Pieces curve(EdgeId edge, FaceId face, bool side) {
        Pieces& at = pieces_[edge.index()];
        if (at.count != 0) {
            return at;
        }
        std::vector<double> t = sample(edge, b_.edge_range(edge), b_.edge_length(edge));
        std::vector<Vec2> line;
        double length = 0;
        for (const double s : t) {
            const Vec3 x = body_.frame.to_frame(b_.edge_point(edge, s));
            length += line.empty() ? 0.0 : (x.head<2>() - line.back()).norm();
            line.emplace_back(x.head<2>());
        }
        if (side && length <= lean_ * b_.edge_length(edge)) {
            add_rib(edge, face);
            return {};
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
        at.first = static_cast<Index>(edges_.size());
        const EdgeNodes* given = given_edge(edge);
        if (given == nullptr) {
            const auto ends = b_.edge_vertices(edge);
            add_curve(edge, {vertex(ends[0]), vertex(ends[1])}, std::move(t), std::move(line), false);
        } else {
            add_given_curves(edge, *given, length);
        }
        at.count = static_cast<Index>(edges_.size()) - at.first;
        return at;
    }

    void add_given_curves(EdgeId edge, const EdgeNodes& given, double length) {
        const std::vector<Index> vertices = given_vertices(edge, given);
        const auto range = b_.edge_range(edge);
        for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
            const std::array part{given.parameters[i], given.parameters[i + 1]};
            std::vector<double> t = sample(edge, part, length * (part[1] - part[0]) / (range[1] - range[0]));
            std::vector<Vec2> line;
            for (const double s : t) {
                line.emplace_back(body_.frame.to_frame(b_.edge_point(edge, s)).template head<2>());
            }
            add_curve(edge, {vertices[i], vertices[i + 1]}, std::move(t), std::move(line), true);
        }
    }

    void add_curve(EdgeId edge, const std::array<Index, 2>& ends, std::vector<double> t, std::vector<Vec2> line,
                   bool given) {
        line.front() = body_.vertices[ends[0]].template head<2>();
        line.back() = body_.vertices[ends[1]].template head<2>();
        body_.curves.push_back({ends, 0, b_.tag(1, edge.index()), given});
        body_.plane.add(line);
        edges_.push_back(edge);
        parameters_.push_back(std::move(t));
    }

    /// Parameters of a range, about \p length long, whose points, joined by lines, keep to the curve within the chord
    /// error, and to the spacing.
    [[nodiscard]] std::vector<double> sample(EdgeId edge, const std::array<double, 2>& range, double length) const {
        constexpr std::size_t most = 4096;
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
        const double scale = d.norm() + length;
        const auto off_line = [&](double t) {
            const Vec2 x = plane(t) - a;
            return std::abs(x[0] * d[1] - x[1] * d[0]) > 1e-9 * d.norm() * scale;
        };
        const double pieces = std::ceil(length / spacing_);
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
    const BoundaryMesh* given_;
    double chord_, spacing_;
    LocalSizes sizes_;
    double lean_;  ///< of an edge along the direction at most, sine of the angle
    ExtrudedBody body_;
    std::vector<Index> vertex_;                      ///< of each vertex of the model
    std::unordered_map<Index, Index> given_vertex_;  ///< by given node
    std::vector<Pieces> pieces_;
    std::vector<char> is_rib_;          ///< an edge is in body_.ribs
    std::vector<Smallest> curve_size_;  ///< by edge id
    std::vector<EdgeId> edges_;         ///< of the curves; not valid for lines of a given mesh
    std::vector<std::vector<double>> parameters_;
    std::vector<FaceId> caps_, sides_;
    std::vector<std::optional<Vec3>> planes_;
    std::vector<double> middle_;
};

}  // namespace pavior
