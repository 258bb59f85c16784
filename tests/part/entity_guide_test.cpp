#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/entity_guide.hpp>

#include <cmath>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Nodes slide on circles, walls and plane faces; vertices are fixed, the inside is free") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    const AnyModel model = b;
    // Faces: bottom 0, top 1, wall 2. Edges: circles below and above, the seam.
    std::int32_t circle = -1;
    for (std::int32_t e = 0; e < 3; ++e) {
        if (b.edge_vertices(EdgeId{e})[0] == b.edge_vertices(EdgeId{e})[1] && b.edge_point(EdgeId{e}, 0).z() == 3) {
            circle = e;
        }
    }
    std::int32_t wall = -1, top = -1;
    for (std::int32_t f = 0; f < 3; ++f) {
        const Vec3 x = b.face_point(FaceId{f}, b.closest_on_face(FaceId{f}, Vec3(2, 0, 1.5)));
        wall = (x - Vec3(2, 0, 1.5)).norm() < 1e-9 ? f : wall;
        top = std::abs(b.face_point(FaceId{f}, Vec2::Zero()).z() - 3) < 1e-9 && f != wall ? f : top;
    }
    REQUIRE(circle >= 0);
    REQUIRE(wall >= 0);
    REQUIRE(top >= 0);
    const Vec2 start = b.closest_on_face(FaceId{wall}, Vec3(0, 2, 1));
    const EntityGuide guide(model,
                            {{0, 0, Vec2::Zero()},
                             {1, circle, Vec2::Zero()},
                             {2, wall, start},
                             {2, top, Vec2::Zero()},
                             {3, 0, Vec2::Zero()}},
                            1e-9);
    CHECK(guide.size() == 5);
    CHECK(guide.freedom(0) == Freedom::fixed);
    CHECK(guide.freedom(1) == Freedom::curve);
    CHECK(guide.freedom(2) == Freedom::surface);
    CHECK(guide.freedom(4) == Freedom::space);
    CHECK_FALSE(guide.concurrent());
    const Vec3 on_circle = guide.project(1, Vec3(-3, 3, 5));
    CHECK((on_circle - Vec3(-std::sqrt(2.0), std::sqrt(2.0), 3)).norm() < 1e-9);
    CHECK(std::abs(guide.direction(1, on_circle).normalized().dot(Vec3(1, 1, 0).normalized())) == Approx(1));
    const Vec3 on_wall = guide.project(2, Vec3(0.3, 2.2, 1.1));
    CHECK(on_wall.head<2>().norm() == Approx(2).epsilon(1e-12));
    CHECK(on_wall.z() == Approx(1.1));
    const Vec3 radial = Vec3(on_wall.x(), on_wall.y(), 0).normalized();
    CHECK(std::abs(guide.direction(2, on_wall).normalized().dot(radial)) == Approx(1));
    CHECK((guide.project(3, Vec3(0.5, 0.5, 4)) - Vec3(0.5, 0.5, 3)).norm() < 1e-9);
}

TEST_CASE("Of straight edges and known planes the model is not asked, and threads may; ends are not passed") {
    TestBrep b;
    add_prism(b, rectangle(2, 1), 0, 1);
    const AnyModel model = b;
    std::int32_t along = -1;
    for (std::int32_t e = 0; e < 12; ++e) {
        along = (b.edge_point(EdgeId{e}, 0) - b.edge_point(EdgeId{e}, 1)).norm() == 2 ? e : along;
    }
    const EntityGuide guide(model, {{1, along, Vec2::Zero()}}, 1e-9);
    CHECK(guide.concurrent());
    const Vec3 first = b.edge_point(EdgeId{along}, 0), last = b.edge_point(EdgeId{along}, 1);
    CHECK((guide.project(0, 0.25 * first + 0.75 * last + Vec3(0, 0.2, 0.1)) - (0.25 * first + 0.75 * last)).norm() <
          1e-12);
    CHECK((guide.project(0, last + 3 * (last - first)) - last).norm() < 1e-12);
    const archetype::Brep bare(b);
    const AnyModel other = bare;
    const EntityGuide same(other, {{1, along, Vec2::Zero()}}, 1e-9);
    CHECK(same.project(0, Vec3(1, 2, 3)) == guide.project(0, Vec3(1, 2, 3)));
}
