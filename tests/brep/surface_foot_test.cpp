#include <pavior/brep/surface_foot.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <cmath>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("From a place nearby the foot is found to the tolerance, on and off the surface") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 2, 2, 3);
    const FaceId side = b.solid_faces(solid)[2].face;
    for (const double height : {0.0, 0.05, -0.05}) {
        for (const Vec2& place : {Vec2(0.3, 0.4), Vec2(0.9, 0.1), Vec2(0.5, 1.0)}) {
            const Vec3 on = b.face_point(side, place);
            const Vec3 x = on + height * Vec3(on[0], on[1], 0).normalized();
            const auto foot = surface_foot(b, side, x, place + Vec2(0.04, -0.1), 1e-10);
            REQUIRE(foot.has_value());
            CHECK((foot->uv - place).norm() < 1e-7);
            CHECK(foot->distance == Approx(std::abs(height)).margin(1e-12));
            CHECK(foot->regular);
        }
    }
}

namespace {

/// A cone: the circle of radius 1 at v = 0, its tip at v = 1.
struct Cone : TestBrep {
    FaceId face;
    Cone() {
        const VertexId tip = vertex({0, 0, 1}), rim = vertex({1, 0, 0});
        face = wall(arc(rim, rim, Vec3::Zero(), Vec3::UnitZ()), line(tip, tip), {});
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId, const Vec3& x) const { return {0, x[2]}; }
};

}  // namespace

TEST_CASE("No foot where the parameters are degenerate") {
    const Cone cone;
    CHECK_FALSE(surface_foot(cone, cone.face, Vec3(0.2, 0, 0.9), Vec2(0, 1), 1e-9).has_value());
    const SurfaceFoot at_tip = projected_foot(cone, cone.face, Vec3(0, 0, 1));
    CHECK(at_tip.distance < 1e-9);
    CHECK_FALSE(at_tip.regular);
    CHECK(projected_foot(cone, cone.face, Vec3(0.5, 0, 0.5)).regular);
}
