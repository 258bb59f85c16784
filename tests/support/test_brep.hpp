#pragma once
// A boundary representation built in code: straight edges and circular arcs, flat faces and walls between two edges.
#include <pavior/brep/brep.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pavior::test {

/// A model of `brep`. Tags are the id + 1.
class TestBrep {
public:
    struct Edge {
        std::array<VertexId, 2> ends;
        bool arc = false;
        /// Of an arc: point(t) = center + cos t x + sin t y.
        Vec3 center = Vec3::Zero(), x = Vec3::Zero(), y = Vec3::Zero();
        double angle = 1.0;  ///< parameter range is [0, angle]
    };
    struct Face {
        std::vector<EdgeLoop> loops;
        bool wall = false;
        Vec3 origin = Vec3::Zero(), du = Vec3::Zero(), dv = Vec3::Zero();  ///< of a flat face
        EdgeId bottom, top;  ///< of a wall: point(u, v) = (1 - v) bottom(u) + v top(u), u in [0, 1]
    };

    VertexId vertex(const Vec3& p) {
        points_.push_back(p);
        return id<VertexId>(points_.size() - 1);
    }
    EdgeId line(VertexId a, VertexId b) {
        Edge edge;
        edge.ends = {a, b};
        edges_.push_back(edge);
        return id<EdgeId>(edges_.size() - 1);
    }
    /// Arc from a to b about an axis (right-hand sense) through the centre; the full circle if a == b.
    EdgeId arc(VertexId a, VertexId b, const Vec3& center, const Vec3& axis) {
        const Vec3 x = vertex_point(a) - center, y = axis.normalized().cross(x), end = vertex_point(b) - center;
        double angle = std::atan2(end.dot(y), end.dot(x));
        angle = a == b ? 2 * std::numbers::pi : angle <= 0 ? angle + 2 * std::numbers::pi : angle;
        edges_.push_back({{a, b}, true, center, x, y, angle});
        return id<EdgeId>(edges_.size() - 1);
    }
    /// A flat face with the given normal; loops are as requirement 2 of brep wants them.
    FaceId flat(std::vector<EdgeLoop> loops, const Vec3& normal) {
        Face f;
        const OrientedEdge first = loops.at(0).at(0);
        f.origin = edge_point(first.edge, 0.0);
        f.du = normal.unitOrthogonal();
        f.dv = normal.normalized().cross(f.du);
        f.loops = std::move(loops);
        faces_.push_back(std::move(f));
        return id<FaceId>(faces_.size() - 1);
    }
    /// A wall between two edges of equal sense; its normal is tangent(bottom) x (bottom to top).
    FaceId wall(EdgeId bottom, EdgeId top, std::vector<EdgeLoop> loops) {
        Face f;
        f.wall = true;
        f.bottom = bottom;
        f.top = top;
        f.loops = std::move(loops);
        faces_.push_back(std::move(f));
        return id<FaceId>(faces_.size() - 1);
    }
    SolidId solid(std::vector<OrientedFace> faces) {
        solids_.push_back(std::move(faces));
        return id<SolidId>(solids_.size() - 1);
    }
    /// The line between two vertices in either sense; made if there is none.
    OrientedEdge joint(VertexId a, VertexId b) {
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (!edges_[e].arc && (edges_[e].ends == std::array{a, b} || edges_[e].ends == std::array{b, a})) {
                return {id<EdgeId>(e), edges_[e].ends[0] == a};
            }
        }
        return {line(a, b), true};
    }
    /// The closed polygon through vertices, edges shared with what is there.
    EdgeLoop polygon(const std::vector<VertexId>& v) {
        EdgeLoop loop;
        for (std::size_t i = 0; i < v.size(); ++i) {
            loop.push_back(joint(v[i], v[(i + 1) % v.size()]));
        }
        return loop;
    }
    /// A flat face through vertices, counter-clockwise seen from the tip of the normal, with polygonal holes.
    FaceId flat_polygon(const std::vector<VertexId>& v, const std::vector<std::vector<VertexId>>& holes = {}) {
        Vec3 normal = Vec3::Zero();
        for (std::size_t i = 0; i < v.size(); ++i) {
            normal += vertex_point(v[i]).cross(vertex_point(v[(i + 1) % v.size()]));
        }
        std::vector<EdgeLoop> loops{polygon(v)};
        for (const auto& hole : holes) {
            loops.push_back(polygon(hole));
        }
        return flat(std::move(loops), normal);
    }

    [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
    [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }
    [[nodiscard]] std::size_t face_count() const { return faces_.size(); }
    [[nodiscard]] std::size_t solid_count() const { return solids_.size(); }
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId s) const { return solids_.at(s.index()); }
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId f) const { return faces_.at(f.index()).loops; }
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId e) const { return edges_.at(e.index()).ends; }
    [[nodiscard]] Vec3 vertex_point(VertexId v) const { return points_.at(v.index()); }
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId e) const { return {0.0, edges_.at(e.index()).angle}; }
    [[nodiscard]] Vec3 edge_point(EdgeId e, double t) const {
        const Edge& edge = edges_.at(e.index());
        const Vec3 a = vertex_point(edge.ends[0]), b = vertex_point(edge.ends[1]);
        return edge.arc ? Vec3(edge.center + std::cos(t) * edge.x + std::sin(t) * edge.y) : Vec3((1 - t) * a + t * b);
    }
    [[nodiscard]] Vec3 edge_derivative(EdgeId e, double t) const {
        const Edge& edge = edges_.at(e.index());
        return edge.arc ? Vec3(std::cos(t) * edge.y - std::sin(t) * edge.x)
                        : Vec3(vertex_point(edge.ends[1]) - vertex_point(edge.ends[0]));
    }
    [[nodiscard]] double edge_length(EdgeId e) const {
        const Edge& edge = edges_.at(e.index());
        return edge_derivative(e, 0.0).norm() * edge.angle;
    }
    [[nodiscard]] Vec3 face_point(FaceId f, const Vec2& uv) const {
        const Face& face = faces_.at(f.index());
        return face.wall ? Vec3((1 - uv[1]) * at(face.bottom, uv[0]) + uv[1] * at(face.top, uv[0]))
                         : Vec3(face.origin + uv[0] * face.du + uv[1] * face.dv);
    }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const {
        const Face& face = faces_.at(f.index());
        if (!face.wall) {
            return {face.du, face.dv};
        }
        return {(1 - uv[1]) * slope(face.bottom, uv[0]) + uv[1] * slope(face.top, uv[0]),
                at(face.top, uv[0]) - at(face.bottom, uv[0])};
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId f, const Vec3& x) const {
        const Face& face = faces_.at(f.index());
        if (!face.wall) {
            return {(x - face.origin).dot(face.du), (x - face.origin).dot(face.dv)};
        }
        Vec2 best = Vec2::Zero();
        for (int i = 0; i <= 64; ++i) {
            for (int j = 0; j <= 64; ++j) {
                const Vec2 uv(i / 64.0, j / 64.0);
                if ((face_point(f, uv) - x).norm() < (face_point(f, best) - x).norm()) {
                    best = uv;
                }
            }
        }
        for (int step = 0; step < 20; ++step) {  // Gauss-Newton
            const auto [du, dv] = face_derivatives(f, best);
            const Vec3 r = x - face_point(f, best);
            const double a = du.dot(du), c = du.dot(dv), d = dv.dot(dv), det = a * d - c * c;
            best += Vec2(d * du.dot(r) - c * dv.dot(r), a * dv.dot(r) - c * du.dot(r)) / det;
        }
        return best;
    }
    [[nodiscard]] Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        const Face& face = faces_.at(f.index());
        const double s = t / edges_.at(e.index()).angle;
        if (face.wall && (e == face.bottom || e == face.top)) {
            return {s, e == face.bottom ? 0.0 : 1.0};
        }
        if (face.wall && edge_vertices(face.bottom)[0] == edge_vertices(face.bottom)[1]) {
            const bool upward = edge_vertices(e)[0] == edge_vertices(face.bottom)[0];  // the seam
            return {forward == upward ? 1.0 : 0.0, upward ? s : 1.0 - s};
        }
        return closest_on_face(f, edge_point(e, t));
    }
    [[nodiscard]] std::array<double, 2> face_period(FaceId f) const {
        const Face& face = faces_.at(f.index());
        const auto ends = face.wall ? edge_vertices(face.bottom) : std::array{VertexId{0}, VertexId{1}};
        return {ends[0] == ends[1] ? 1.0 : 0.0, 0.0};
    }
    [[nodiscard]] int tag(int /*dim*/, std::size_t index) const { return static_cast<int>(index) + 1; }

private:
    template <class I>
    [[nodiscard]] static I id(std::size_t i) {
        return I{static_cast<std::int32_t>(i)};
    }
    [[nodiscard]] Vec3 at(EdgeId e, double s) const { return edge_point(e, s * edges_.at(e.index()).angle); }
    [[nodiscard]] Vec3 slope(EdgeId e, double s) const {
        const double angle = edges_.at(e.index()).angle;
        return angle * edge_derivative(e, s * angle);
    }

    std::vector<Vec3> points_;
    std::vector<Edge> edges_;
    std::vector<Face> faces_;
    std::vector<std::vector<OrientedFace>> solids_;
};

using Polygon = std::vector<Vec2>;

/// Vertices of a polygon at height z.
inline std::vector<VertexId> lift(TestBrep& b, const Polygon& polygon, double z) {
    std::vector<VertexId> result;
    for (const Vec2& p : polygon) {
        result.push_back(b.vertex({p[0], p[1], z}));
    }
    return result;
}

/// Appends the side faces between two rings of vertices, bottom to top, seen from outside with the ring running right.
inline void add_sides(TestBrep& b, const std::vector<VertexId>& low, const std::vector<VertexId>& high,
                      std::vector<OrientedFace>& faces) {
    for (std::size_t i = 0; i < low.size(); ++i) {
        const std::size_t j = (i + 1) % low.size();
        faces.push_back({b.flat_polygon({low[i], low[j], high[j], high[i]}), true});
    }
}

/// Prism over a polygon (counter-clockwise) with polygonal holes (clockwise), `storeys` side faces above each other.
/// The bottom is face 0 of the solid, with its normal upwards (not outward); the top is face 1.
inline SolidId add_prism(TestBrep& b, const Polygon& outer, double z0, double z1,
                         const std::vector<Polygon>& holes = {}, int storeys = 1) {
    std::vector<std::vector<std::vector<VertexId>>> rings(1 + holes.size());
    for (std::size_t i = 0; i < rings.size(); ++i) {
        for (int k = 0; k <= storeys; ++k) {
            rings[i].push_back(lift(b, i == 0 ? outer : holes[i - 1], z0 + (z1 - z0) * k / storeys));
        }
    }
    const auto cap = [&](std::size_t k) {
        std::vector<std::vector<VertexId>> inner;
        for (std::size_t i = 1; i < rings.size(); ++i) {
            inner.push_back(rings[i][k]);
        }
        return b.flat_polygon(rings[0][k], inner);
    };
    std::vector<OrientedFace> faces{{cap(0), false}, {cap(static_cast<std::size_t>(storeys)), true}};
    for (const auto& ring : rings) {
        for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
            add_sides(b, ring[k], ring[k + 1], faces);
        }
    }
    return b.solid(std::move(faces));
}

inline Polygon rectangle(double x, double y) { return {{0, 0}, {x, 0}, {x, y}, {0, y}}; }
inline Polygon l_shape() { return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}; }

/// A ring of a given radius at height z: its seam vertex and the full circle, counter-clockwise from above.
struct Ring {
    VertexId v;
    EdgeId e;
};
inline Ring add_circle(TestBrep& b, double radius, double z, Vec2 center = {0, 0}) {
    const VertexId v = b.vertex({center[0] + radius, center[1], z});
    return {v, b.arc(v, v, {center[0], center[1], z}, {0, 0, 1})};
}

/// The wall between two rings with a seam edge; its normal points away from the axis.
inline FaceId add_round_wall(TestBrep& b, const Ring& low, const Ring& high) {
    const EdgeId seam = b.joint(low.v, high.v).edge;
    return b.wall(low.e, high.e, {{{low.e, true}, {seam, true}, {high.e, false}, {seam, false}}});
}

/// A (conical) cylinder; with inner > 0 a pipe. Faces: bottom (not outward), top, outer wall, inner wall (not outward).
inline SolidId add_cylinder(TestBrep& b, double r0, double r1, double height, double inner = 0.0) {
    const Ring low = add_circle(b, r0, 0), high = add_circle(b, r1, height);
    std::vector<EdgeLoop> bottom{{{low.e, true}}}, top{{{high.e, true}}};
    std::vector<OrientedFace> walls{{add_round_wall(b, low, high), true}};
    if (inner > 0.0) {
        const Ring in_low = add_circle(b, inner, 0), in_high = add_circle(b, inner, height);
        bottom.push_back({{in_low.e, false}});
        top.push_back({{in_high.e, false}});
        walls.push_back({add_round_wall(b, in_low, in_high), false});
    }
    std::vector<OrientedFace> faces{{b.flat(bottom, {0, 0, 1}), false}, {b.flat(top, {0, 0, 1}), true}};
    faces.insert(faces.end(), walls.begin(), walls.end());
    return b.solid(std::move(faces));
}

/// A pyramid over a square: no two faces are apart.
inline SolidId add_pyramid(TestBrep& b) {
    const auto base = lift(b, rectangle(1, 1), 0);
    const VertexId apex = b.vertex({0.5, 0.5, 1});
    std::vector<OrientedFace> faces{{b.flat_polygon(base), false}};
    for (std::size_t i = 0; i < 4; ++i) {
        faces.push_back({b.flat_polygon({base[i], base[(i + 1) % 4], apex}), true});
    }
    return b.solid(std::move(faces));
}

/// A box whose face z = height carries a smaller box: not a sweep, one side face has two loops.
inline SolidId add_boss(TestBrep& b) {
    const auto low = lift(b, rectangle(3, 3), 0), high = lift(b, rectangle(3, 3), 1);
    const Polygon inner{{1, 1}, {2, 1}, {2, 2}, {1, 2}};
    const auto foot = lift(b, inner, 1), top = lift(b, inner, 2);
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}};
    faces.push_back({b.flat_polygon(high, {{foot[0], foot[3], foot[2], foot[1]}}), true});
    faces.push_back({b.flat_polygon(top), true});
    add_sides(b, low, high, faces);
    add_sides(b, foot, top, faces);
    return b.solid(std::move(faces));
}

/// A square at the bottom, a triangle on top: one side face is a triangle. Bottom is face 0, top 1, the triangle last.
inline SolidId add_square_to_triangle(TestBrep& b) {
    const auto low = lift(b, rectangle(2, 2), 0), high = lift(b, {{0.5, 0.5}, {1.5, 0.5}, {1.0, 1.5}}, 1);
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}, {b.flat_polygon(high), true}};
    for (std::size_t i = 0; i < 4; ++i) {
        const VertexId p = high[std::min<std::size_t>(i, 2)], q = high[i < 2 ? i + 1 : i == 2 ? 2 : 0];
        const std::size_t j = (i + 1) % 4;
        faces.push_back({p == q ? b.flat_polygon({low[i], low[j], p}) : b.flat_polygon({low[i], low[j], q, p}), true});
    }
    std::swap(faces[4], faces[5]);
    return b.solid(std::move(faces));
}

/// A unit box whose walls y = 0 and x = 1 have two storeys; the walls x = 0 and y = 1 are in one piece.
inline SolidId add_half_stacked_box(TestBrep& b) {
    const auto low = lift(b, rectangle(1, 1), 0), mid = lift(b, rectangle(1, 1), 0.4),
               high = lift(b, rectangle(1, 1), 1);
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}, {b.flat_polygon(high), true}};
    faces.push_back({b.flat_polygon({low[0], low[1], mid[1], mid[0]}), true});
    faces.push_back({b.flat_polygon({mid[0], mid[1], high[1], high[0]}), true});
    faces.push_back({b.flat_polygon({low[1], low[2], mid[2], mid[1]}), true});
    faces.push_back({b.flat_polygon({mid[1], mid[2], high[2], high[1]}), true});
    faces.push_back({b.flat_polygon({low[2], low[3], high[3], high[2], mid[2]}), true});
    faces.push_back({b.flat_polygon({low[3], low[0], mid[0], high[0], high[3]}), true});
    return b.solid(std::move(faces));
}

/// A row of boxes along x that share faces; each has its lower x face first, its upper x face second.
inline std::vector<SolidId> add_box_row(TestBrep& b, const std::vector<double>& x) {
    std::vector<SolidId> solids;
    std::vector<std::vector<VertexId>> section;
    for (const double at : x) {
        section.push_back({b.vertex({at, 0, 0}), b.vertex({at, 1, 0}), b.vertex({at, 1, 1}), b.vertex({at, 0, 1})});
    }
    std::vector<FaceId> walls;
    for (const auto& ring : section) {
        walls.push_back(b.flat_polygon(ring));
    }
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        std::vector<OrientedFace> faces{{walls[i], false}, {walls[i + 1], true}};
        add_sides(b, section[i], section[i + 1], faces);
        solids.push_back(b.solid(std::move(faces)));
    }
    return solids;
}

}  // namespace pavior::test
