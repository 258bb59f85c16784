#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/field.hpp>
#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/fronts.hpp>
#include <pavior/marking/groups.hpp>

using namespace pavior;

TEST_CASE("the re-entrant curve of an L has two fronts, each ahead into the solid") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    REQUIRE(fronts.size() == 2);
    Vec3 sum(0, 0, 0);
    for (const Front& front : fronts) {
        CHECK(front.kind == CurveKind::corner);
        CHECK(front.surface.kind == SurfaceKind::plane);
        REQUIRE(front.chain.size() == 2);
        CHECK(mesh.nodes[front.chain[0]].head<2>() == Eigen::Vector2d(1, 1));
        CHECK(std::abs(front.surface.normal(Vec3(0, 0, 0)).dot(front.ahead[0])) < 1e-12);
        sum += front.ahead[0];
    }
    CHECK((sum - Vec3(-1, -1, 0)).norm() < 1e-12);
}

TEST_CASE("a convex solid has no fronts") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false);
    const TetTopology topology = tet_topology(mesh);
    CHECK(sheet_fronts(mesh, topology, front_boundary(mesh, topology), 1e-6).empty());
}
