#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/decompose/cut_lines.hpp>

#include <cmath>
#include <optional>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

const Axis x_axis{Vec3::Zero(), Vec3::UnitX()};
const double half = std::sqrt(0.5);

}  // namespace

TEST_CASE("A point's distance from a line does not depend on the line's origin") {
    const Axis line{{1, 2, 3}, {0, half, half}};
    CHECK(distance_to_line({1, 2, 3}, line) == Approx(0).margin(1e-15));
    CHECK(distance_to_line({5, 2, 3}, line) == Approx(4));
    CHECK(distance_to_line({5, 9, 10}, line) == Approx(4));
    CHECK(distance_to_line({1, 3, 2}, line) == Approx(std::sqrt(2)));
    CHECK(distance_to_line({1, 3, 2}, {{1, -5, -4}, {0, -half, -half}}) == Approx(std::sqrt(2)));
}

TEST_CASE("Lines that meet have a common point, those that pass each other within the tolerance its middle") {
    const std::optional<Vec3> meet = common_point(x_axis, {{3, 4, 4}, {0, half, half}}, 1e-9);
    REQUIRE(meet);
    CHECK((*meet - Vec3(3, 0, 0)).norm() < 1e-12);
    const std::optional<Vec3> slanted = common_point({{-5, 0, 0}, {1, 0, 0}}, {{1, 1, 0}, {half, half, 0}}, 1e-9);
    REQUIRE(slanted);
    CHECK(slanted->norm() < 1e-12);
    const Axis passing{{7, 1, 0.01}, {0, -1, 0}};
    const std::optional<Vec3> near = common_point(x_axis, passing, 0.02);
    REQUIRE(near);
    CHECK((*near - Vec3(7, 0, 0.005)).norm() < 1e-12);
    const std::optional<Vec3> other = common_point(passing, x_axis, 0.02);
    REQUIRE(other);
    CHECK((*other - *near).norm() < 1e-12);
    CHECK_FALSE(common_point(x_axis, passing, 0.005));
}

TEST_CASE("Parallel lines have no common point, nor has a line with itself") {
    CHECK_FALSE(common_point(x_axis, {{0, 1, 0}, {1, 0, 0}}, 1e-6));
    CHECK_FALSE(common_point(x_axis, {{0, 1, 0}, {-1, 0, 0}}, 10));
    CHECK_FALSE(common_point(x_axis, x_axis, 1e-6));
}

TEST_CASE("The two sides of a plane, a half-plane and a cylinder") {
    const CutSurface plane = CutPlane{{0, 0, 1}, {0, 0, 1}};
    CHECK(signed_distance(plane, {5, -3, 3}) == Approx(2));
    CHECK(signed_distance(plane, {5, -3, -1}) == Approx(-2));
    CHECK(signed_distance(plane, {7, 7, 1}) == 0);
    const CutSurface cylinder = CutCylinder{{1, 0, 0}, {0, 1, 0}, 2, {0, 0, 1}};
    CHECK(signed_distance(cylinder, {1, 9, 0}) == Approx(-2));
    CHECK(signed_distance(cylinder, {1, -9, 5}) == Approx(3));
    CHECK(signed_distance(cylinder, {3, 4, 0}) == Approx(0).margin(1e-12));
    const CutSurface half_plane = CutHalfPlane{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};  // z = 1, y > 0
    const double above = signed_distance(half_plane, {4, 2, 3});
    const double below = signed_distance(half_plane, {-4, 1, 0.5});
    CHECK(std::abs(above) == Approx(2));
    CHECK(std::abs(below) == Approx(0.5));
    CHECK(above * below < 0);
    CHECK(signed_distance(half_plane, {0, -1, 3}) == 0);
    CHECK(signed_distance(half_plane, {0, -1, -3}) == 0);
}

TEST_CASE("A plane is the same through another of its points and with its normal turned round") {
    const CutPlane plane{{1, 2, 3}, {half, half, 0}};
    CHECK(same_surface(plane, plane, 1e-6));
    CHECK(same_surface(plane, CutPlane{{2, 1, -8}, {-half, -half, 0}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutPlane{{2, 2, 3}, {half, half, 0}}, 1e-6));
    CHECK(same_surface(plane, CutPlane{{1.001, 2, 3}, {half, half, 0}}, 0.01));
    CHECK_FALSE(same_surface(plane, CutPlane{{1, 2, 3}, {half, -half, 0}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutPlane{{1, 2, 3}, Vec3(1, 1.01, 0).normalized()}, 1e-6));
}

TEST_CASE("A half-plane is where its line is and lies to one side of it") {
    const CutHalfPlane plane{{1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK(same_surface(plane, CutHalfPlane{{-4, 0, 0}, {-1, 0, 0}, {0, 1, 0}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutHalfPlane{{1, 0, 0}, {1, 0, 0}, {0, -1, 0}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutHalfPlane{{1, 0.5, 0}, {1, 0, 0}, {0, 1, 0}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutHalfPlane{{1, 0, 0}, {1, 0, 0}, {0, half, half}}, 1e-6));
    CHECK_FALSE(same_surface(plane, CutPlane{{1, 0, 0}, {0, 0, 1}}, 1e-6));
}

TEST_CASE("A cylinder is the same along its axis, whatever its seam") {
    const CutCylinder cylinder{{1, 2, 0}, {0, 0, 1}, 2, {1, 0, 0}};
    CHECK(same_surface(cylinder, CutCylinder{{1, 2, 7}, {0, 0, -1}, 2, {0, 1, 0}}, 1e-6));
    CHECK_FALSE(same_surface(cylinder, CutCylinder{{1, 2, 0}, {0, 0, 1}, 2.1, {1, 0, 0}}, 1e-6));
    CHECK_FALSE(same_surface(cylinder, CutCylinder{{1, 2.1, 0}, {0, 0, 1}, 2, {1, 0, 0}}, 1e-6));
    CHECK_FALSE(same_surface(cylinder, CutCylinder{{1, 2, 0}, {0, 1, 0}, 2, {1, 0, 0}}, 1e-6));
    CHECK_FALSE(same_surface(cylinder, CutPlane{{1, 2, 0}, {0, 0, 1}}, 1e-6));
}

TEST_CASE("Lines are straight; arcs are not, and know their circle") {
    TestBrep b;
    const Vec3 centre(1, 2, 3);
    const Vec3 axis = Vec3(1, 1, 1).normalized();
    const Vec3 arm = 2 * Vec3(1, -1, 0).normalized();
    const VertexId p = b.vertex(centre + arm);
    const EdgeId line = b.line(p, b.vertex(centre + arm + Vec3(3, 4, 5)));
    const EdgeId circle = b.arc(p, p, centre, axis);
    const EdgeId quarter = b.arc(p, b.vertex(centre + axis.cross(arm)), centre, axis);
    const EdgeId sliver =
        b.arc(p, b.vertex(centre + std::cos(0.05) * arm + std::sin(0.05) * axis.cross(arm)), centre, axis);
    const archetype::Brep model(b);
    CHECK(is_straight(model, line));
    CHECK_FALSE(circle_of(model, line));
    for (const EdgeId edge : {circle, quarter, sliver}) {
        CAPTURE(edge.value);
        CHECK_FALSE(is_straight(model, edge));
        const std::optional<CircleArc> arc = circle_of(model, edge);
        REQUIRE(arc);
        CHECK(arc->radius == Approx(2).epsilon(1e-9));
        CHECK((arc->axis.origin - centre).norm() < 1e-8);
        CHECK(arc->axis.direction.norm() == Approx(1));
        CHECK(arc->axis.direction.cross(axis).norm() < 1e-9);
    }
}

TEST_CASE("How far a point is from a segment and from an arc, beyond their ends, too") {
    const CutCurve segment{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    CHECK(distance_to_curve({1, 0, 0}, segment) == Approx(0).margin(1e-15));
    CHECK(distance_to_curve({1, 3, 0}, segment) == Approx(3));
    CHECK(distance_to_curve({7, 4, 0}, segment) == Approx(5));
    const double half = std::sqrt(0.5);
    const CutCurve quarter{{1, 0, 5}, {half, half, 5}, {0, 1, 5}};
    CHECK(distance_to_curve({std::cos(0.3), std::sin(0.3), 5}, quarter) == Approx(0).margin(1e-15));
    CHECK(distance_to_curve({3 * half, 3 * half, 5}, quarter) == Approx(2));
    CHECK(distance_to_curve({half, half, 7}, quarter) == Approx(2));
    CHECK(distance_to_curve({0, 0, 5}, quarter) == Approx(1));
    CHECK(distance_to_curve({-1, 0, 5}, quarter) == Approx(std::sqrt(2.0)));  // on the circle, beyond the end
}

TEST_CASE("Edges on curves of cuts are found, also parts of a curve, and no others") {
    TestBrep b;
    add_prism(b, rectangle(2, 1), 0, 3);
    CHECK(edges_on_curves(b, std::span<const SolidCut>{}).empty());
    const SolidCut cut{SolidId{0}, {}, CutReason::square, {{{0, 0, -1}, {0, 0, 2}, {0, 0, 5}}}};
    const std::vector<EdgeId> on = edges_on_curves(b, std::span(&cut, 1));
    REQUIRE(on.size() == 1);
    for (const VertexId v : b.edge_vertices(on[0])) {
        CHECK(b.vertex_point(v).head<2>().norm() == 0);
    }
    const SolidCut shorter{SolidId{0}, {}, CutReason::square, {{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}}};
    CHECK(edges_on_curves(b, std::span(&shorter, 1)).empty());
}
