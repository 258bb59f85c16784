#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/groups.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

/// A U whose prongs end at different heights of the second axis, moved by \p step.
std::size_t groups_of(double step) {
    const auto solid = tet_meshes::voxels({3, 2, 1}, [](Index i, Index j, Index) { return i != 1 || j == 0; });
    ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    for (Vec3& x : mesh.nodes) {
        x[0] += step * x[1] * (x[0] > 1.5 ? 1 : 0);  // turns one side of the notch
    }
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    REQUIRE(fronts.size() == 4);
    return sheet_groups(fronts, boundary, mesh.nodes, Grouping::exact, 1e-6, 30.0).size();
}

/// The sheets of a T whose arms rise by 8 and 3 degrees: the undersides share one if they may bend it.
std::vector<SheetGroup> groups_of_t(Grouping grouping, double angle) {
    const auto solid = tet_meshes::voxels({3, 1, 2}, [](Index i, Index, Index k) { return i == 1 || k == 1; });
    ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    for (Vec3& x : mesh.nodes) {
        if (x[2] == 1 && (x[0] == 0 || x[0] == 3)) {
            x[2] += std::tan((x[0] == 0 ? 8 : 3) * std::numbers::pi / 180);
        }
    }
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    REQUIRE(fronts.size() == 4);
    return sheet_groups(fronts, boundary, mesh.nodes, grouping, 1e-6, angle);
}

}  // namespace

TEST_CASE("fronts on one plane share a sheet") {
    CHECK(groups_of(0.0) == 3);  // the floor of the notch continues both ways
    CHECK(groups_of(0.1) == 3);
}

TEST_CASE("fronts that face each other on tilted planes share a sheet if they see each other within the angle") {
    CHECK(groups_of_t(Grouping::exact, 8.5).size() == 4);
    CHECK(groups_of_t(Grouping::blended, 7.5).size() == 4);
    const std::vector<SheetGroup> bent = groups_of_t(Grouping::blended, 8.5);
    REQUIRE(bent.size() == 3);
    for (const SheetGroup& group : bent) {
        const bool flank = std::abs(group.members[0].surface.axis[0]) > 0.9;
        REQUIRE(group.members.size() == (flank ? 1 : 2));
        if (!flank) {
            CHECK(std::abs(group.members[0].surface.axis.dot(group.members[1].surface.axis)) ==
                  Approx(std::cos(11 * std::numbers::pi / 180)));
        }
    }
}
