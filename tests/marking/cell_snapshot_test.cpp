#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/cell_snapshot.hpp>

using namespace pavior;

TEST_CASE("the snapshot of a box of boxes is valid and its simple blocks are cubes") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 3, 1));
    const CellSnapshot s = cell_snapshot(mesh);
    CHECK(s.report.valid());
    CHECK(s.complex.cells.size() == 6);
    CHECK(s.complex.corners.size() == 48);
    const CellQuality q = simple_quality(mesh, s);
    CHECK(q.jacobian == Approx(1.0).epsilon(1e-9));
    CHECK(q.aspect == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("an irregular corner has no quality") {
    ReferenceMesh mesh = tet_meshes::read_reference("ref_pyramid_table58").mesh;
    mesh.layers.clear();  // four curves meet at the apex
    const CellSnapshot s = cell_snapshot(mesh);
    CHECK_FALSE(s.report.valid());
    CHECK(simple_quality(mesh, s).jacobian == -1);
}
