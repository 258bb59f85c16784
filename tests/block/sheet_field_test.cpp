#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/block/sheet_field.hpp>

using namespace pavior;

TEST_CASE("the field of a front is zero on its curve and on the material side of its patch") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const ReferenceMesh mesh = tet_meshes::reference(solid, 2, false);
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    const std::vector<SheetGroup> groups = sheet_groups(fronts, boundary, mesh.nodes, Grouping::exact, 1e-6, 30.0);
    REQUIRE(groups.size() == 2);
    for (const SheetGroup& group : groups) {
        const SheetCut sheet = sheet_field(mesh, group, fronts, boundary, 1e-6);
        REQUIRE(sheet.values.size() == mesh.nodes.size());
        CHECK_FALSE(sheet.curved);
        CHECK(sheet.start_edges.size() == 2);
        const Vec3 normal = group.members[0].surface.normal(Vec3(0, 0, 0));
        std::size_t zero = 0;
        for (const Index i : IndexRange(mesh.nodes.size())) {
            const Vec3& x = mesh.nodes[i];
            const double plane = group.members[0].sign * normal.dot(x - Vec3(1, 1, 0));
            zero += sheet.values[i] == 0 ? 1 : 0;
            if (std::abs(plane) > 1e-3) {
                CHECK(sheet.values[i] * plane > 0);
            }
            const bool patch = std::abs(plane) < 1e-9 && (x[0] > 1 || x[1] > 1);
            CHECK((patch ? sheet.values[i] < 0 || sheet.fixed[i] != 0 : true));
            if (x[0] == 1 && x[1] == 1) {
                CHECK(sheet.values[i] == 0);
            }
        }
        CHECK(zero >= 9);
    }
}
