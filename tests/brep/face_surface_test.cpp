#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/face_surface.hpp>
#include <pavior/math/parametric_surface.hpp>

using namespace pavior;

static_assert(parametric_surface<FaceSurface<test::TestBrep>>);

TEST_CASE("a face is a parametric surface") {
    test::TestBrep b;
    test::add_cylinder(b, 1.0, 2.0, 3.0);
    const FaceSurface<test::TestBrep> wall{&b, FaceId{0}};
    const Vec2 uv(0.25, 0.5);
    CHECK((wall.point(uv) - Vec3(0, 1.5, 1.5)).norm() < 1e-14);
    const auto [du, dv] = wall.derivatives(uv);
    CHECK((wall.point(uv + Vec2(1e-6, 0)) - wall.point(uv) - 1e-6 * du).norm() < 1e-10);
    CHECK((wall.point(uv + Vec2(0, 1e-6)) - wall.point(uv) - 1e-6 * dv).norm() < 1e-10);
    CHECK((wall.point(wall.closest(wall.point(uv))) - wall.point(uv)).norm() < 1e-12);
}
