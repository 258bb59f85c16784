#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/repair_sheet.hpp>

using namespace pavior;

TEST_CASE("a repair sheet is cut where it starts, and leaves no trace but its layers") {
    CutMesh cut{tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false), {}, {}};
    const std::size_t curves = cut.mesh.curves.size();
    RepairSheet repair;
    repair.kind = SheetKind::axis;
    repair.surface.point = Vec3(0.7, 0.5, 0.5);
    repair.surface.axis = Vec3(1, 0, 0);
    for (const FeatureEdge& edge : cut.mesh.curves) {
        const Vec3& a = cut.mesh.nodes[edge.nodes[0]];
        const Vec3& b = cut.mesh.nodes[edge.nodes[1]];
        if ((a[0] < 0.7) != (b[0] < 0.7) && a[1] + a[2] == 0) {
            repair.edges.push_back({std::min(edge.nodes[0], edge.nodes[1]), std::max(edge.nodes[0], edge.nodes[1])});
        }
    }
    REQUIRE(repair.edges.size() == 1);
    const auto added = cut_repairs(cut, {repair}, Propagation::full, 1e-9, 2);
    REQUIRE(added.size() == 1);
    CHECK(added[0] == cut.mesh.layers.size());
    CHECK(cut.mesh.curves.size() == curves + 4);  // four edges bisected, no waiting curve left
    const CellSnapshot s = cell_snapshot(cut.mesh);
    CHECK(s.report.valid());
    CHECK(s.complex.corners.size() == 16);
}
