#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/decompose/face_shape.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

bool on_axis(const Axis& axis, const Vec3& origin, const Vec3& direction) {
    return axis.direction.cross(direction).norm() < 1e-7 &&
           (axis.origin - origin).cross(direction).norm() < 1e-7 * (1 + origin.norm());
}

}  // namespace

TEST_CASE("Planes have a point and a normal that leaves the solid") {
    TestBrep b;
    const SolidId prism = add_prism(b, l_shape(), 2, 3);
    const archetype::Brep model(b);
    for (const OrientedFace& f : b.solid_faces(prism)) {
        const FaceShape shape = face_shape(model, f);
        CHECK(shape.kind == FaceKind::plane);
        CHECK_FALSE(shape.hollow);
        CHECK(shape.axis.direction.norm() == Approx(1));
        const auto [du, dv] = b.face_derivatives(f.face, Vec2::Zero());
        const Vec3 outward = (f.outward ? 1 : -1) * du.cross(dv).normalized();
        CHECK((shape.axis.direction - outward).norm() < 1e-12);
        CHECK(std::abs((shape.axis.origin - b.face_point(f.face, Vec2::Zero())).dot(outward)) < 1e-12);
    }
    CHECK(face_shape(b, b.solid_faces(prism)[0]).axis.direction.dot(Vec3::UnitZ()) == Approx(-1));
    CHECK(face_shape(b, b.solid_faces(prism)[1]).axis.direction.dot(Vec3::UnitZ()) == Approx(1));
}

TEST_CASE("Cylinders have axis and radius; round holes are hollow") {
    TestBrep b;
    const SolidId pipe = add_cylinder(b, 2, 2, 1, 0.5);
    const auto faces = b.solid_faces(pipe);
    const FaceShape outer = face_shape(b, faces[2]);
    CHECK(outer.kind == FaceKind::cylinder);
    CHECK(outer.radius == Approx(2).epsilon(1e-9));
    CHECK_FALSE(outer.hollow);
    CHECK(on_axis(outer.axis, Vec3::Zero(), Vec3::UnitZ()));
    const FaceShape inner = face_shape(b, faces[3]);
    CHECK(inner.kind == FaceKind::cylinder);
    CHECK(inner.radius == Approx(0.5).epsilon(1e-9));
    CHECK(inner.hollow);
    CHECK(on_axis(inner.axis, Vec3::Zero(), Vec3::UnitZ()));
    CHECK(face_shape(b, {faces[3].face, true}).kind == FaceKind::cylinder);
    CHECK_FALSE(face_shape(b, {faces[3].face, true}).hollow);
}

TEST_CASE("A part of a cylinder is one, in any place") {
    for (const double angle : {0.3, 1.5, 3.0, 5.0}) {
        CAPTURE(angle);
        TestBrep b;
        const Vec3 centre(10, -20, 5);
        const Vec3 d = Vec3(1, 2, 2).normalized();
        const Vec3 x = 3 * d.unitOrthogonal();
        const Vec3 y = d.cross(x);
        std::vector<VertexId> low, high;
        for (const double t : {0.0, angle}) {
            low.push_back(b.vertex(centre + std::cos(t) * x + std::sin(t) * y));
            high.push_back(b.vertex(centre + std::cos(t) * x + std::sin(t) * y + 4 * d));
        }
        const EdgeId bottom = b.arc(low[0], low[1], centre, d);
        const EdgeId top = b.arc(high[0], high[1], centre + 4 * d, d);
        const FaceId wall =
            b.wall(bottom, top, {{{bottom, true}, b.joint(low[1], high[1]), {top, false}, b.joint(high[0], low[0])}});
        for (const bool outward : {true, false}) {
            const FaceShape shape = face_shape(b, {wall, outward});
            CHECK(shape.kind == FaceKind::cylinder);
            CHECK(shape.radius == Approx(3).epsilon(1e-6));
            CHECK(shape.hollow != outward);
            CHECK(on_axis(shape.axis, centre, d));
        }
    }
}

TEST_CASE("Cones are surfaces of revolution, but no cylinders, however slender") {
    TestBrep b;
    for (const double top : {1.0, 1.9, 1.999}) {
        const auto faces = b.solid_faces(add_cylinder(b, 2, top, 3));
        const FaceShape cone = face_shape(b, faces[2]);
        CAPTURE(top);
        CHECK(cone.kind == FaceKind::revolved);
        CHECK(on_axis(cone.axis, Vec3::Zero(), Vec3::UnitZ()));
        CHECK_FALSE(cone.hollow);
        CHECK(face_shape(b, {faces[2].face, false}).hollow);
    }
}

TEST_CASE("A wall between skew lines is neither plane nor round") {
    TestBrep b;
    const VertexId p = b.vertex({0, 0, 0}), q = b.vertex({1, 0, 0}), r = b.vertex({1, 1, 1}), s = b.vertex({0, 1, 0.2});
    const EdgeId bottom = b.line(p, q), top = b.line(s, r);
    const FaceId wall = b.wall(bottom, top, {{{bottom, true}, b.joint(q, r), {top, false}, b.joint(s, p)}});
    CHECK(face_shape(b, {wall, true}).kind == FaceKind::other);
}
