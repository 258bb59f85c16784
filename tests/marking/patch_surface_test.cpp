#include "support/catch.hpp"

#include <pavior/marking/patch_surface.hpp>

#include <cmath>
#include <vector>

using namespace pavior;

namespace {

/// The surface whose axis is the third one through (1, 0, 0).
PatchSurface round_surface(SurfaceKind kind, double radius, double tube = 0) {
    PatchSurface s;
    s.kind = kind;
    s.point = Vec3(1, 0, 0);
    s.radius = radius;
    s.tube = tube;
    return s;
}

}  // namespace

TEST_CASE("distances and normals of round surfaces") {
    const PatchSurface cylinder = round_surface(SurfaceKind::cylinder, 2);
    CHECK(cylinder.distance(Vec3(1, 5, 7)) == Approx(3));
    CHECK((cylinder.normal(Vec3(1, 5, 7)) - Vec3::UnitY()).norm() < 1e-15);
    const PatchSurface sphere = round_surface(SurfaceKind::sphere, 2);
    CHECK(sphere.distance(Vec3(1, 3, 4)) == Approx(3));
    const PatchSurface cone = round_surface(SurfaceKind::cone, 1);
    CHECK(cone.distance(Vec3(3, 0, 0)) == Approx(std::sqrt(2.0)));
    CHECK(std::abs(cone.distance(Vec3(4, 0, 3))) < 1e-12);
    const PatchSurface torus = round_surface(SurfaceKind::torus, 3, 1);
    CHECK(torus.distance(Vec3(4, 0, 3)) == Approx(2));
    CHECK((torus.normal(Vec3(4, 0, 3)) - Vec3::UnitZ()).norm() < 1e-12);
}

TEST_CASE("the sense turns a surface inside out") {
    PatchSurface hole = round_surface(SurfaceKind::cylinder, 2);
    hole.sense = -1;
    CHECK(hole.distance(Vec3(1, 5, 7)) == Approx(-3));
    CHECK((hole.normal(Vec3(1, 5, 7)) + Vec3::UnitY()).norm() < 1e-15);
}

TEST_CASE("normals point in the direction in which distances grow") {
    for (const SurfaceKind kind : {SurfaceKind::plane, SurfaceKind::cylinder, SurfaceKind::cone, SurfaceKind::sphere,
                                   SurfaceKind::torus, SurfaceKind::facets}) {
        PatchSurface s = round_surface(kind, 1.5, 0.5);
        s.facets = {{Vec3(0, 0, 0), Vec3::UnitZ(), 1}, {Vec3(1, 0, 0), Vec3::UnitZ(), 1}};
        const Vec3 x(1.7, -0.4, 0.6);
        CHECK(s.distance(x + 1e-6 * s.normal(x)) - s.distance(x) == Approx(1e-6).epsilon(1e-3));
    }
}
