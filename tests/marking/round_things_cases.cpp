#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/verify_dual.hpp>
#include <pavior/marking/detail/round_things.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

/// A bar of square section bent to a disc and round the third axis by an angle in [0, 1] of a turn.
ReferenceMesh bent_bar(double turn) {
    auto tets = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1), 10);
    for (Vec3& x : tets.mesh.nodes) {
        const double u = 2 * x[0] - 1;
        const double v = 2 * x[1] - 1;
        const double r = 3 + u * std::sqrt(1 - v * v / 2);
        const double a = 2 * std::numbers::pi * turn * x[2];
        x = Vec3(r * std::cos(a), -r * std::sin(a), v * std::sqrt(1 - u * u / 2));
    }
    return make_reference_mesh(tets.mesh);
}

}  // namespace

TEST_CASE("the ends of a bent tube are cross-sections of one torus") {
    const ReferenceMesh mesh = bent_bar(0.25);
    std::vector<detail::RoundThing> things = detail::round_things(mesh, cell_snapshot(mesh));
    REQUIRE(things.size() == 2);
    for (const detail::RoundThing& thing : things) {
        CHECK(thing.lengthwise);
        REQUIRE(thing.tube);
        CHECK(thing.tube->kind == SurfaceKind::torus);
        CHECK(std::abs(thing.tube->axis[2]) == Approx(1).epsilon(1e-3));
        CHECK(thing.tube->radius == Approx(3).epsilon(0.02));
        CHECK(std::abs(thing.axis[2]) < 1e-6);
    }
    CHECK(std::abs(things[0].axis.dot(things[1].axis)) < 1e-3);
    detail::merge_coaxial(things, 0.05);
    CHECK(things.size() == 1);
}

TEST_CASE("the centre of a ball and the axis of a cylinder") {
    auto ball = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1), 8);
    for (Vec3& x : ball.mesh.nodes) {
        const Vec3 d = 2 * x - Vec3(1, 1, 1);
        const double most = d.cwiseAbs().maxCoeff();
        x = Vec3(5, 0, 0) + (most > 0 ? Vec3(most * d.normalized()) : d);
    }
    const ReferenceMesh mesh = make_reference_mesh(ball.mesh);
    std::vector<detail::RoundThing> things = detail::round_things(mesh, cell_snapshot(mesh));
    detail::merge_coaxial(things, 0.05);
    REQUIRE(things.size() == 1);  // the patch and the cell have one centre
    CHECK((things[0].point - Vec3(5, 0, 0)).norm() < 1e-2);
    CHECK(things[0].axis.isZero());
    CHECK_FALSE(things[0].tube);
}

TEST_CASE("nothing is round about a box") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1), 1, false);
    CHECK(detail::round_things(mesh, cell_snapshot(mesh)).empty());
}

TEST_CASE("the axis of a circle does not depend on how its polygon is sampled") {
    std::vector<Vec3> nodes;
    for (int k = 0; k < 24; k += k < 12 ? 1 : 3) {  // finer on one side, and with nodes on some chords
        const double a = 2 * std::numbers::pi * k / 24;
        nodes.emplace_back(1 + std::cos(a), std::sin(a), 2);
        if (k % 4 == 1) {
            const double b = 2 * std::numbers::pi * (k + (k < 12 ? 1 : 3)) / 24;
            nodes.push_back(0.3 * nodes.back() + 0.7 * Vec3(1 + std::cos(b), std::sin(b), 2));
        }
    }
    std::vector<Index> path;
    for (const Index i : IndexRange(nodes.size())) {
        path.push_back(i);
    }
    path.push_back(0);
    const detail::RoundThing thing = detail::round_chain(nodes, path);
    CHECK((thing.point - Vec3(1, 0, 2)).norm() < 1e-9);
    CHECK(thing.axis.cross(Vec3::UnitZ()).norm() < 1e-9);
}
