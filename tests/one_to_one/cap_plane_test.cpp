#include "support/catch.hpp"
#include "support/domes.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>
#include <pavior/one_to_one/cap_plane.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

FaceId face_of_kind(const GmshBrep& model, const std::string& kind) {
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        if (const FaceId id{static_cast<std::int32_t>(f)}; model.face_kind(id) == kind) {
            return id;
        }
    }
    FAIL("no " + kind);
    return {};
}

}  // namespace

TEST_CASE("Coordinates in a plane and back") {
    const std::vector<std::vector<Vec3>> square{{{0, 0, 2}, {0, 2, 2}, {2, 2, 2}, {2, 0, 2}}};  // clockwise from above
    const auto plane = plane_of_loops(square);
    REQUIRE(plane.has_value());
    CHECK(plane->normal().isApprox(Vec3(0, 0, -1), 1e-14));
    CHECK(plane->origin.isApprox(Vec3(1, 1, 2), 1e-14));
    const Vec3 p(0.3, 1.7, 2);
    CHECK(plane->point(plane->coordinates(p)).isApprox(p, 1e-14));

    std::vector<std::vector<Vec3>> tube = square;  // a second rim the other way round: no area is left
    tube.push_back({{2, 0, 5}, {2, 2, 5}, {0, 2, 5}, {0, 0, 5}});
    CHECK(!plane_of_loops(tube));
    CHECK(!plane_of_loops({}));
}

TEST_CASE("A dome has a plane, a tube has none, nor has a dome that is too steep") {
    const GmshBrep model = GmshBrep::build([] { make_dome(Dome::sphere); });
    const FaceId dome = face_of_kind(model, "Sphere");
    CHECK(has_seam(model, dome));
    CHECK(!has_seam(model, face_of_kind(model, "Plane")));
    const auto plane = cap_plane(model, dome);
    REQUIRE(plane.has_value());
    CHECK(plane->normal().isApprox(Vec3(0, 0, 1), 1e-9));
    CHECK(!cap_plane(model, face_of_kind(model, "Cylinder")));
    const double lean = std::asin(2.0 / 3) * 180 / M_PI;  // of the sphere's normal at the rim
    CHECK(cap_plane(model, dome, lean + 0.5));
    CHECK(!cap_plane(model, dome, lean - 0.5));
}

TEST_CASE("Points are lifted to a face along a line, also next to its pole") {
    const GmshBrep model = GmshBrep::build([] { make_dome(Dome::sphere); });
    const FaceId dome = face_of_kind(model, "Sphere");
    for (const Vec2& p : {Vec2(0, 0), Vec2(1e-7, 0), Vec2(0.5, -1), Vec2(-1.9, 0.3)}) {
        CAPTURE(p[0], p[1]);
        const Vec3 expected(p[0], p[1], std::sqrt(9 - p.squaredNorm()));
        for (const double height : {1.0, 2.2, 3.5}) {
            const Vec3 x(p[0], p[1], height);
            CHECK((lift_to_face(model, dome, x, Vec3::UnitZ()) - expected).norm() < 1e-8);
        }
    }
    // a line that misses the sphere: the nearest point
    CHECK((lift_to_face(model, dome, Vec3(5, 0, 4), Vec3::UnitZ()).norm()) == Approx(3).epsilon(1e-9));
}

TEST_CASE("The boundary of a cap with a seam is its rims, the outer one first") {
    const GmshBrep model = GmshBrep::build([] { make_dome(Dome::ring); });
    const FaceId dome = face_of_kind(model, "Sphere");
    const BoundaryMesh mesh = mesh_edges(model, std::vector<int>(model.edge_count(), 12));
    const CapBoundary boundary = cap_boundary(model, mesh, dome);
    REQUIRE(boundary.plane.has_value());
    REQUIRE(boundary.offsets == std::vector<std::size_t>{0, 12, 24});
    for (std::size_t i = 0; i < 24; ++i) {
        CHECK(boundary.points[i].head<2>().norm() == Approx(i < 12 ? 2 : 0.8).epsilon(1e-9));
        CHECK(boundary.points[i] == mesh.nodes[boundary.ids[i]]);
        CHECK(boundary.uv[i] == boundary.plane->coordinates(boundary.points[i]));
    }
    const FaceId wall = face_of_kind(model, "Cylinder");
    const CapBoundary tube = cap_boundary(model, mesh, wall);
    CHECK(!tube.plane);
    CHECK(tube.offsets.size() == 2);  // one loop, the seam twice
}
