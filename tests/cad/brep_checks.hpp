#pragma once
// Checks that hold for every closed solid of a brep.

#include "support/catch.hpp"

#include <pavior/brep/brep.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace pavior::test {

inline EdgeId edge_id(std::size_t i) { return {static_cast<std::int32_t>(i)}; }
inline FaceId face_id(std::size_t i) { return {static_cast<std::int32_t>(i)}; }
inline SolidId solid_id(std::size_t i) { return {static_cast<std::int32_t>(i)}; }
inline VertexId vertex_id(std::size_t i) { return {static_cast<std::int32_t>(i)}; }

inline double at_fraction(const std::array<double, 2>& range, double s) { return range[0] + s * (range[1] - range[0]); }

/// Parameters of a loop's edge, in the sense of the loop.
template <brep B>
std::vector<Vec2> run(const B& b, FaceId f, const OrientedEdge& e, int samples) {
    std::vector<Vec2> uv;
    for (int i = 0; i <= samples; ++i) {
        const double s = static_cast<double>(i) / samples;
        uv.push_back(b.edge_on_face(e.edge, at_fraction(b.edge_range(e.edge), e.forward ? s : 1 - s), f, e.forward));
    }
    return uv;
}

template <brep B>
std::array<VertexId, 2> ends(const B& b, const OrientedEdge& e) {
    const auto v = b.edge_vertices(e.edge);
    return e.forward ? std::array{v[0], v[1]} : std::array{v[1], v[0]};
}

template <brep B>
double size_of(const B& b) {
    Vec3 low = b.edge_point(EdgeId{0}, b.edge_range(EdgeId{0})[0]);
    Vec3 high = low;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        for (const double s : {0.0, 0.25, 0.5, 0.75}) {
            const Vec3 x = b.edge_point(edge_id(e), at_fraction(b.edge_range(edge_id(e)), s));
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
        }
    }
    return (high - low).norm();
}

/// Edges: ends are the vertices, derivative and length agree with the points.
template <brep B>
void check_edges(const B& b, double size) {
    for (std::size_t i = 0; i < b.edge_count(); ++i) {
        const EdgeId e = edge_id(i);
        CAPTURE(b.tag(1, i));
        const auto range = b.edge_range(e);
        const auto v = b.edge_vertices(e);
        CHECK((b.edge_point(e, range[0]) - b.vertex_point(v[0])).norm() <= 1e-6 * size);
        CHECK((b.edge_point(e, range[1]) - b.vertex_point(v[1])).norm() <= 1e-6 * size);
        const double h = 1e-5 * (range[1] - range[0]);
        for (const double s : {0.2, 0.5, 0.9}) {
            const double t = at_fraction(range, s);
            const Vec3 difference = (b.edge_point(e, t + h) - b.edge_point(e, t - h)) / (2 * h);
            CHECK((difference - b.edge_derivative(e, t)).norm() <= 1e-4 * difference.norm());
        }
        double length = 0;
        for (int k = 0; k < 500; ++k) {
            length +=
                (b.edge_point(e, at_fraction(range, (k + 1) / 500.0)) - b.edge_point(e, at_fraction(range, k / 500.0)))
                    .norm();
        }
        CHECK(length == Approx(b.edge_length(e)).epsilon(1e-4));
    }
}

/// Loops: closed in space and, away from poles, in the parameters; on the surface; the outer one to the left.
template <brep B>
void check_loops(const B& b, double size, bool poles) {
    for (std::size_t i = 0; i < b.face_count(); ++i) {
        const FaceId f = face_id(i);
        CAPTURE(b.tag(2, i));
        const auto loops = b.face_loops(f);
        REQUIRE(!loops.empty());
        for (std::size_t l = 0; l < loops.size(); ++l) {
            double twice = 0;
            Vec2 last = run(b, f, loops[l].back(), 4).back();
            for (std::size_t k = 0; k < loops[l].size(); ++k) {
                const OrientedEdge& e = loops[l][k];
                CHECK(ends(b, e)[1] == ends(b, loops[l][(k + 1) % loops[l].size()])[0]);
                const std::vector<Vec2> uv = run(b, f, e, 32);
                if (!poles) {
                    CHECK((uv.front() - last).norm() <= 1e-5 * std::max(1.0, last.norm()));
                }
                for (const Vec2& p : uv) {
                    twice += last.x() * p.y() - last.y() * p.x();
                    last = p;
                }
                for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
                    const double t = at_fraction(b.edge_range(e.edge), s);
                    const Vec3 there = b.face_point(f, b.edge_on_face(e.edge, t, f, e.forward));
                    CHECK((there - b.edge_point(e.edge, t)).norm() <= 2e-6 * size);
                }
            }
            CHECK((twice > 0) == (l == 0));
        }
    }
}

/// Solids: each edge twice, in opposite senses as seen from outside.
template <brep B>
void check_solids(const B& b) {
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        CAPTURE(b.tag(3, s));
        std::map<EdgeId, std::array<int, 2>> uses;
        for (const OrientedFace& face : b.solid_faces(solid_id(s))) {
            for (const EdgeLoop& loop : b.face_loops(face.face)) {
                for (const OrientedEdge& e : loop) {
                    ++uses[e.edge][e.forward == face.outward ? 0 : 1];
                }
            }
        }
        for (const auto& [edge, count] : uses) {
            CAPTURE(b.tag(1, edge.index()));
            CHECK(count == std::array{1, 1});
        }
    }
}

/// V - E + F - holes of all solids that share nothing: 2 (shells - genus).
template <brep B>
int euler(const B& b) {
    int holes = 0;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        holes += static_cast<int>(b.face_loops(face_id(f)).size()) - 1;
    }
    return static_cast<int>(b.vertex_count()) - static_cast<int>(b.edge_count()) + static_cast<int>(b.face_count()) -
           holes;
}

/// Integral of x . n / 3 and of 1 over a face, by scan lines between its loops in the parameter plane.
template <brep B>
std::array<double, 2> flux_and_area(const B& b, FaceId f, const Vec3& centre, int lines = 200) {
    std::vector<std::array<Vec2, 2>> segments;
    double low = 1e300;
    double high = -1e300;
    for (const EdgeLoop& loop : b.face_loops(f)) {
        for (const OrientedEdge& e : loop) {
            const std::vector<Vec2> uv = run(b, f, e, 200);
            for (std::size_t i = 0; i + 1 < uv.size(); ++i) {
                segments.push_back({uv[i], uv[i + 1]});
                low = std::min({low, uv[i].y(), uv[i + 1].y()});
                high = std::max({high, uv[i].y(), uv[i + 1].y()});
            }
        }
    }
    std::array<double, 2> sum{};
    const double dv = (high - low) / lines;
    for (int line = 0; line < lines; ++line) {
        const double v = low + (line + 0.5) * dv;
        std::vector<double> u;
        for (const auto& [p, q] : segments) {
            if ((p.y() < v) != (q.y() < v)) {
                u.push_back(p.x() + (q.x() - p.x()) * (v - p.y()) / (q.y() - p.y()));
            }
        }
        std::sort(u.begin(), u.end());
        REQUIRE(u.size() % 2 == 0);
        for (std::size_t i = 0; i < u.size(); i += 2) {
            constexpr int steps = 24;
            const double du = (u[i + 1] - u[i]) / steps;
            for (int k = 0; k < steps; ++k) {
                const Vec2 uv(u[i] + (k + 0.5) * du, v);
                const auto [xu, xv] = b.face_derivatives(f, uv);
                const Vec3 n = xu.cross(xv);
                sum[0] += (b.face_point(f, uv) - centre).dot(n) * du * dv / 3;
                sum[1] += n.norm() * du * dv;
            }
        }
    }
    return sum;
}

/// The volume that the outward faces of a solid enclose.
template <brep B>
double enclosed_volume(const B& b, SolidId s, int lines = 200) {
    double volume = 0;
    const Vec3 centre = b.vertex_point(VertexId{0});
    for (const OrientedFace& face : b.solid_faces(s)) {
        volume += (face.outward ? 1 : -1) * flux_and_area(b, face.face, centre, lines)[0];
    }
    return volume;
}

/// Faces: derivatives and projections.
template <class B>
void check_faces(const B& b, double size) {
    for (std::size_t i = 0; i < b.face_count(); ++i) {
        const FaceId f = face_id(i);
        CAPTURE(b.tag(2, i));
        const Vec2 uv = b.face_interior(f);
        const Vec2 extent = b.face_bounds(f)[1] - b.face_bounds(f)[0];
        const Vec3 x = b.face_point(f, uv);
        const auto [du, dv] = b.face_derivatives(f, uv);
        const Vec2 h = 1e-5 * extent;
        const Vec3 by_u = (b.face_point(f, uv + Vec2(h.x(), 0)) - b.face_point(f, uv - Vec2(h.x(), 0))) / (2 * h.x());
        const Vec3 by_v = (b.face_point(f, uv + Vec2(0, h.y())) - b.face_point(f, uv - Vec2(0, h.y()))) / (2 * h.y());
        CHECK((by_u - du).norm() <= 1e-5 * du.norm());
        CHECK((by_v - dv).norm() <= 1e-5 * dv.norm());
        for (const double offset : {0.0, 1e-3 * size, -1e-3 * size}) {
            const Vec2 foot = b.closest_on_face(f, x + offset * du.cross(dv).normalized());
            CHECK((b.face_point(f, foot) - x).norm() <= 1e-6 * size);
        }
        for (const int d : {0, 1}) {
            const double period = b.face_period(f)[static_cast<std::size_t>(d)];
            if (period > 0) {
                Vec2 next = uv;
                next[d] += period;
                CHECK((b.face_point(f, next) - x).norm() <= 1e-7 * size);
            }
        }
    }
}

template <class B>
void check_all(const B& b, bool poles = false, double volume_error = 5e-3) {
    const double size = size_of(b);
    check_edges(b, size);
    check_loops(b, size, poles);
    check_faces(b, size);
    check_solids(b);
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        CHECK(enclosed_volume(b, solid_id(s)) == Approx(b.solid_volume(solid_id(s))).epsilon(volume_error));
    }
}

}  // namespace pavior::test
