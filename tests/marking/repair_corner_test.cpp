#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/marking/repair_corner.hpp>

using namespace pavior;

TEST_CASE("the apex of a pyramid with four sides is split through two opposite edges") {
    ReferenceMesh mesh = tet_meshes::read_reference("ref_pyramid_table58").mesh;
    mesh.layers.clear();
    const CellSnapshot s = cell_snapshot(mesh);
    const auto repair = repair_corner(mesh, s, 1e-6, 5.0);
    REQUIRE(repair);
    CHECK(repair->kind == SheetKind::corner);
    CHECK((mesh.nodes[repair->node] - Vec3(1.5, 1.5, 1.8)).norm() < 1e-12);
    CHECK_FALSE(repair->tets.empty());
    CHECK(std::abs(repair->surface.distance(mesh.nodes[repair->node])) < 1e-9);
}

TEST_CASE("the pyramid on a box becomes valid with the counts of table 5.8") {
    ReferenceMesh mesh = tet_meshes::read_reference("ref_pyramid_table58").mesh;
    mesh.layers.clear();
    const MarkedMesh full = mark_sheets(mesh);
    CHECK(full.report.valid);
    CHECK(full.report.blocks == 92);
    CHECK(full.report.nodes == 177);
    MarkingOptions options;
    options.propagation = Propagation::stop;
    const MarkedMesh stop = mark_sheets(mesh, options);
    CHECK(stop.report.valid);
    CHECK(stop.report.blocks == 84);
    CHECK(stop.report.nodes == 165);
    CHECK(stop.report.quality > 0.05);
}

TEST_CASE("a solid whose corners are regular needs no split") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false);
    CHECK_FALSE(repair_corner(mesh, cell_snapshot(mesh), 1e-6, 2.0));
}

TEST_CASE("a corner with one chain is crossed, one with two is parted") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1), 1, false);
    detail::CornerRing ring;
    ring.node = 0;
    ring.directions = {Vec3(1, 0, 0)};
    const auto across = detail::cross_sheet(mesh, ring);
    REQUIRE(across);
    CHECK(across->surface.axis == Vec3(1, 0, 0));
    CHECK(across->surface.point == mesh.nodes[0]);
    ring.directions = {Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const auto between = detail::cross_sheet(mesh, ring);
    REQUIRE(between);
    CHECK(between->surface.axis.dot(ring.directions[0]) * between->surface.axis.dot(ring.directions[1]) < -0.4);
    ring.directions.emplace_back(0, 0, 1);
    CHECK_FALSE(detail::cross_sheet(mesh, ring));
}

TEST_CASE("a corner is split through two opposite chains by the plane that parts the others") {
    detail::CornerRing ring;
    ring.directions = {Vec3(1, 0, 0), Vec3(0, 0.6, 0.8), Vec3(-1, 0, 0), Vec3(0, 0.6, -0.8)};
    const auto split = detail::try_split(ring, 0, 2);
    REQUIRE(split);
    CHECK(std::abs(split->normal[2]) == Approx(1));
    CHECK(split->clearance == Approx(0.8));
}
