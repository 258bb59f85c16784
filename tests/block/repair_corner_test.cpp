#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/block/mark_sheets.hpp>
#include <pavior/block/repair_corner.hpp>

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
