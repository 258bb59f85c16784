#include <pavior/brep/face_corners.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

/// Angles at the start of each edge of the first loop, for the face as a solid sees it.
std::vector<double> angles(const TestBrep& b, OrientedFace f) {
    EdgeLoop loop = b.face_loops(f.face)[0];
    if (!f.outward) {
        std::reverse(loop.begin(), loop.end());
        for (OrientedEdge& use : loop) {
            use.forward = !use.forward;
        }
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        result.push_back(corner_angle(b, f, loop[(i + loop.size() - 1) % loop.size()], loop[i]));
    }
    return result;
}

}  // namespace

TEST_CASE("Interior angles of a plane polygon, seen from either side") {
    TestBrep b;
    const FaceId f = b.flat_polygon(lift(b, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3));
    const std::vector<double> front = angles(b, {f, true});
    const double expected[] = {90, 180, 90, 90, 270, 90, 90};
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(front[i] == Approx(expected[i]));
    }
    std::vector<double> back = angles(b, {f, false});
    std::sort(back.begin(), back.end());
    CHECK(back.front() == Approx(90));
    CHECK(back.back() == Approx(270));
    double sum = 0;
    for (const double angle : back) {
        sum += angle;
    }
    CHECK(sum == Approx(900));
}

TEST_CASE("Corners of a round wall at its seam are right angles, inside and outside") {
    TestBrep b;
    const SolidId pipe = add_cylinder(b, 2, 2, 3, 1);
    for (const OrientedFace& f : b.solid_faces(pipe)) {
        const std::vector<double> corners = angles(b, f);
        for (const double angle : corners) {
            CHECK(angle == Approx(corners.size() == 4 ? 90 : 180));
        }
    }
}

TEST_CASE("The cusp between a line and a tangent arc is not mistaken for a slit") {
    TestBrep b;  // the region between the circle of radius 1 and its tangent at (1, 0)
    const VertexId p = b.vertex({1, 0, 0}), q = b.vertex({0, 1, 0}), r = b.vertex({1, 1, 0});
    const EdgeId arc = b.arc(p, q, {0, 0, 0}, {0, 0, 1});
    const FaceId f = b.flat({{b.joint(p, r), b.joint(r, q), {arc, false}}}, {0, 0, 1});
    const std::vector<double> corners = angles(b, {f, true});
    CHECK(corners[0] == Approx(0).margin(10));
    CHECK(corners[1] == Approx(90));
    CHECK(corners[2] == Approx(0).margin(10));
    const FaceId half = b.flat({{{arc, true}, b.joint(q, r), b.joint(r, p)}}, {0, 0, -1});
    CHECK(angles(b, {half, true})[0] == Approx(0).margin(10));
}

TEST_CASE("Normals point out of the solid that uses the face") {
    TestBrep b;
    const SolidId pipe = add_cylinder(b, 2, 2, 3, 1);
    const auto faces = b.solid_faces(pipe);
    const double z[] = {-1, 1};
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(outside_normal(b, faces[i], b.face_loops(faces[i].face)[0][0], 0.3)[2] == Approx(z[i]));
    }
    for (std::size_t i = 2; i < 4; ++i) {
        OrientedEdge bottom = b.face_loops(faces[i].face)[0][0];
        bottom.forward = faces[i].outward;
        const Vec3 normal = outside_normal(b, faces[i], bottom, 0.0);
        CHECK((normal - Vec3(i == 2 ? 1 : -1, 0, 0)).norm() < 1e-9);
    }
}

TEST_CASE("Turning of lines and arcs") {
    TestBrep b;
    const VertexId p = b.vertex({1, 0, 0}), q = b.vertex({0, 1, 0}), s = b.vertex({5, 5, 5});
    CHECK(edge_turning(b, b.line(p, s)) == Approx(0).margin(1e-6));
    CHECK(edge_turning(b, b.arc(p, q, {0, 0, 0}, {0, 0, 1})) == Approx(90));
    CHECK(edge_turning(b, b.arc(q, p, {0, 0, 0}, {0, 0, 1})) == Approx(270));
    CHECK(edge_turning(b, b.arc(p, p, {0, 0, 0}, {0, 0, 1})) == Approx(360));
    CHECK(edge_turning(b, b.line(s, b.vertex({5, 5, 5}))) == 0.0);  // degenerate
}
