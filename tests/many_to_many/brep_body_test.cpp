#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/many_to_many/brep_body.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {
const std::vector<SolidId> first{SolidId{0}};
}

TEST_CASE("a boss: caps with the solids on their sides, sides with their curves") {
    TestBrep b;
    add_boss(b);
    const BrepBody<TestBrep> body(b, first, extrusion_along(b, first, Vec3::UnitZ()), 1e-3, 10);
    REQUIRE(body.body().caps.size() == 3);
    CHECK(body.body().caps[0].above == 0);
    CHECK(body.body().caps[0].below == no_index);
    CHECK(body.body().caps[1].below == 0);
    CHECK(body.body().caps[1].curves.size() == 8);
    CHECK(body.body().sides.size() == 8);
    CHECK(body.body().curves.size() == 16);  // not the eight along the direction
    for (const ExtrudedSide& side : body.body().sides) {
        CHECK(side.curves.size() == 2);
    }
    CHECK(body.cap_height(2, {1.5, 1.5}) == 2);
    CHECK(body.cap_face(2) == FaceId{2});
    CHECK(body.side_face(0) == FaceId{3});
    CHECK(body.body().frame.to_space(body.body().vertices[0]) == b.vertex_point(VertexId{0}));
}

TEST_CASE("points of a circle are exact, its polyline keeps the chord error and the spacing") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    const BrepBody<TestBrep> body(b, first, extrusion_along(b, first, Vec3::UnitZ()), 1e-3, 0.2);
    REQUIRE(body.body().curves.size() == 2);
    const std::span<const Vec2> line = body.body().plane[0];
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        CHECK((line[i + 1] - line[i]).norm() <= 0.2);
        CHECK(2 - (0.5 * (line[i] + line[i + 1])).norm() <= 1e-3);
    }
    const Vec3 at = body.curve_point(1, {3, 4});
    CHECK((at.head<2>() - Vec2(1.2, 1.6)).norm() < 1e-13);
    CHECK(at[2] == Approx(3));
}

TEST_CASE("slanted caps have an equation") {
    TestBrep b;
    add_pyramid(b);
    const BrepBody<TestBrep> body(b, first, extrusion_along(b, first, Vec3::UnitZ()), 1e-3, 10);
    CHECK(body.cap_height(1, {0.5, 0.25}) == Approx(0.5));
}

TEST_CASE("what is no extrusion is refused") {
    TestBrep b;
    add_cylinder(b, 1, 0.9, 2);
    CHECK_THROWS_AS(BrepBody<TestBrep>(b, first, extrusion_along(b, first, Vec3::UnitZ()), 1e-3, 1), UnmeshableError);
}
