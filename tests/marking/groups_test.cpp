#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/groups.hpp>

using namespace pavior;

namespace {

/// A U whose prongs end at different heights of the second axis, moved by \p step.
std::size_t groups_of(double step, Grouping grouping) {
    const auto solid = tet_meshes::voxels({3, 2, 1}, [](Index i, Index j, Index) { return i != 1 || j == 0; });
    ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    for (Vec3& x : mesh.nodes) {
        x[0] += step * x[1] * (x[0] > 1.5 ? 1 : 0);  // turns one side of the notch
    }
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    REQUIRE(fronts.size() == 4);
    return sheet_groups(fronts, boundary, mesh.nodes, grouping, 1e-6, 30.0).size();
}

}  // namespace

TEST_CASE("fronts on one plane share a sheet") {
    CHECK(groups_of(0.0, Grouping::exact) == 3);  // the floor of the notch continues both ways
    CHECK(groups_of(0.1, Grouping::exact) == 3);
    CHECK(groups_of(0.1, Grouping::blended) <= 3);
}
