#include <pavior/brep/flat_face.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

TEST_CASE("a plane keeps distances and the sense of its loops") {
    TestBrep b;
    const SolidId solid = add_boss(b);
    const FaceId top = b.solid_faces(solid)[1].face;  // has a hole
    const FlatFace flat = flat_face(b, top, b.face_loops(top));
    REQUIRE(flat.start.size() == 2);
    REQUIRE(flat.start[0].size() == 4);
    for (std::size_t l = 0; l < 2; ++l) {
        double area = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 &p = flat.start[l][i], &q = flat.start[l][(i + 1) % 4];
            CHECK((q - p - flat.chord[l][i]).norm() < 1e-9);
            CHECK((q - p).norm() == Approx(l == 0 ? 3.0 : 1.0));
            area += 0.5 * (p.x() * q.y() - p.y() * q.x());
        }
        CHECK(area == Approx(l == 0 ? 9.0 : -1.0));
    }
    CHECK((flat.start[1][0] - flat.start[0][0]).norm() < std::sqrt(8.0) + 1e-9);
}

TEST_CASE("a wall of a quarter of a cylinder is rolled out") {
    TestBrep b;
    const VertexId a = b.vertex({2, 0, 0}), c = b.vertex({0, 2, 0}), d = b.vertex({2, 0, 3}), e = b.vertex({0, 2, 3});
    const EdgeId low = b.arc(a, c, {0, 0, 0}, {0, 0, 1}), high = b.arc(d, e, {0, 0, 3}, {0, 0, 1});
    const OrientedEdge right = b.joint(c, e), left = b.joint(d, a);
    const FaceId f = b.wall(low, high, {{{low, true}, right, {high, false}, left}});
    const FlatFace flat = flat_face(b, f, b.face_loops(f));
    CHECK(flat.chord[0][0].norm() == Approx(std::acos(-1.0)).epsilon(1e-6));
    CHECK(flat.chord[0][1].norm() == Approx(3.0).epsilon(1e-6));
    CHECK(flat.chord[0][0].dot(flat.chord[0][1]) == Approx(0.0).margin(1e-6));
}
