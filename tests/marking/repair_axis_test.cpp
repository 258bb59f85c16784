#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/mark_sheets.hpp>
#include <pavior/marking/repair_axis.hpp>

#include <cmath>

using namespace pavior;

namespace {

/// A box whose sides are bent to a cylinder round the third axis.
ReferenceMesh cylinder() {
    auto tets = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1), 6);
    for (Vec3& x : tets.mesh.nodes) {
        const double u = 2 * x[0] - 1;
        const double v = 2 * x[1] - 1;
        x[0] = u * std::sqrt(1 - v * v / 2);
        x[1] = v * std::sqrt(1 - u * u / 2);
        x[2] *= 2;
    }
    return make_reference_mesh(tets.mesh);
}

}  // namespace

TEST_CASE("a cylinder asks for two perpendicular planes through its axis") {
    const ReferenceMesh mesh = cylinder();
    const CellSnapshot s = cell_snapshot(mesh);
    CHECK_FALSE(s.report.valid());
    const std::vector<RepairSheet> repairs = repair_axes(mesh, s, 3.0);
    REQUIRE(repairs.size() == 2);
    for (const RepairSheet& repair : repairs) {
        CHECK(repair.kind == SheetKind::axis);
        CHECK(std::abs(repair.surface.axis[2]) < 1e-6);
        CHECK(std::abs(repair.surface.distance(Vec3(0, 0, 1))) < 1e-6);
    }
    CHECK(std::abs(repairs[0].surface.axis.dot(repairs[1].surface.axis)) < 1e-6);
}

TEST_CASE("with them the cylinder has 24 blocks") {
    const MarkedMesh marked = mark_sheets(cylinder());
    CHECK(marked.report.valid);
    CHECK(marked.report.blocks == 24);
    CHECK(marked.report.nodes == 51);
    CHECK(marked.report.quality > 0.3);
}

TEST_CASE("a valid solid needs no axis") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1), 1, false);
    CHECK(repair_axes(mesh, cell_snapshot(mesh), 2.0).empty());
}

TEST_CASE("planes that nearly coincide become one sheet") {
    std::vector<RepairSheet> sheets(4);
    sheets[0].edges = {{0, 1}};
    sheets[1].edges = {{2, 3}};
    sheets[1].surface.point = Vec3(5, 0, 1e-4);
    sheets[1].surface.axis = Vec3(0, 1e-5, -1).normalized();
    sheets[2].surface.point = Vec3(0, 0, 0.1);
    sheets[3].surface.kind = SurfaceKind::cylinder;
    detail::merge_planes(sheets, 1e-3);
    REQUIRE(sheets.size() == 3);
    CHECK(sheets[0].edges == std::vector<std::array<Index, 2>>{{0, 1}, {2, 3}});
    CHECK(sheets[1].surface.point[2] == 0.1);
}
