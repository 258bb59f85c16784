#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_shape.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr double degrees = 57.29577951308232;

/// A prism over the unit square whose top is moved by a vector.
SweepTopology leaning(TestBrep& b, const Vec3& move, double scale = 1.0) {
    const auto low = lift(b, rectangle(1, 1), 0);
    std::vector<VertexId> high;
    for (const VertexId v : low) {
        high.push_back(b.vertex(scale * b.vertex_point(v) + move));
    }
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}, {b.flat_polygon(high), true}};
    add_sides(b, low, high, faces);
    const SolidId solid = b.solid(std::move(faces));
    return sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face);
}

}  // namespace

TEST_CASE("A straight prism is perfect") {
    TestBrep b;
    const SweepShape shape = leaning(b, {0, 0, 3}).shape;
    CHECK(shape.corner_deviation == Approx(0).margin(1e-9));
    CHECK(shape.cap_deviation == Approx(0).margin(1e-9));
    CHECK(shape.rib_ratio == Approx(1));
    CHECK(shape.rib_turn == Approx(0).margin(1e-5));
    CHECK(shape.cap_warp == Approx(0).margin(1e-9));
    CHECK(shape.cap_loops == 1);
    CHECK(shape.cap_edges == 8);
}

TEST_CASE("A leaning prism has skewed corners and caps") {
    TestBrep b;
    const SweepShape shape = leaning(b, {1, 0, 1}).shape;
    CHECK(shape.corner_deviation == Approx(45));
    CHECK(shape.cap_deviation == Approx(45));
    CHECK(shape.rib_ratio == Approx(1));
}

TEST_CASE("Ribs of a lopsided frustum differ in length") {
    TestBrep b;
    const SweepShape shape = leaning(b, {0, 0, 1}, 0.5).shape;
    CHECK(shape.rib_ratio == Approx(std::sqrt(1.5)));
    CHECK(shape.cap_deviation == Approx(std::atan(0.5) * degrees));
}

TEST_CASE("Ribs through storeys add up") {
    TestBrep b;
    const SweepShape shape = best_sweep(b, add_half_stacked_box(b)).shape;
    CHECK(shape.rib_ratio == Approx(1));
    const SweepShape tower = best_sweep(b, add_prism(b, l_shape(), 0, 3, {}, 3)).shape;
    CHECK(tower.rib_ratio == Approx(1));
    CHECK(tower.rib_turn == Approx(0).margin(1e-5));
}

TEST_CASE("Dihedral angles count the material") {
    TestBrep b;
    const SolidId solid = add_prism(b, l_shape(), 0, 1);
    const auto faces = b.solid_faces(solid);
    std::vector<double> angles;
    for (std::size_t i = 2; i < 8; ++i) {
        const OrientedEdge rib = b.face_loops(faces[i].face)[0][1];  // shared with the next side
        angles.push_back(dihedral_angle(b, faces[i], faces[i == 7 ? 2 : i + 1], rib, 0.5));
    }
    std::sort(angles.begin(), angles.end());
    CHECK(angles[0] == Approx(90));
    CHECK(angles[4] == Approx(90));
    CHECK(angles[5] == Approx(270));
}

TEST_CASE("Only angles beyond the limit are obstacles") {
    TestBrep b;
    const SweepTopology sweep = leaning(b, {1, 0, 1});
    CHECK(shape_obstacles(b, sweep, 46).empty());
    const auto obstacles = shape_obstacles(b, sweep, 44);
    CHECK(obstacles.size() == 4);  // two walls with skew corners, two that lean over the caps
    for (const SweepObstacle& obstacle : obstacles) {
        CHECK(obstacle.condition == SweepCondition::four_logical_sides);
        CHECK_THAT(obstacle.reason, Catch::Contains("differs from 90 degrees by 45"));
    }
}
