#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/place_layered_nodes.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Nodes of columns over the cells of caps, 2 intervals an edge of the plane, layers of about 1.
std::vector<Vec3> placed(const std::vector<PolygonCap>& caps, const PolygonBodyOptions& options = {}) {
    const PolygonBody body(caps, options);
    const PlaneArrangement plane = arranged(body);
    const std::vector<CapsOverCell> stacks = caps_over_cells(body.body(), body, plane).stacks;
    const std::vector<char> wanted(plane.cells.size(), 1);
    const PlaneMesh quads = mesh_plane(
        plane, std::vector<int>(plane.edges.size(), 2), wanted, [](Index, const Vec2& x) { return x; },
        GmshRegionMesher{}, [](Index, const Error& error) { throw error; });
    const double size = 1;
    const CapLevels levels =
        solve_level_program(body.body(), body, plane, stacks, size, LevelTolerance{1e-6, 1e-6}, solved);
    detail::LayeredHexBuilder columns(body.body(), plane, quads, stacks, levels);
    detail::LayeredNodePlacer(body.body(), body, plane, stacks, quads, levels, columns).place(1e-9);
    return columns.result().mesh.nodes;
}

std::size_t nodes_at(const std::vector<Vec3>& nodes, double z) {
    return static_cast<std::size_t>(
        std::count_if(nodes.begin(), nodes.end(), [&](const Vec3& x) { return std::abs(x[2] - z) < 1e-12; }));
}

}  // namespace

TEST_CASE("nodes of flat caps lie on them, levels inside keep their height") {
    const std::vector<Vec3> nodes = placed(steps());
    CHECK(nodes.size() == 15 + 15 + 9);
    CHECK(nodes_at(nodes, 0) == 15);
    CHECK(nodes_at(nodes, 1) == 15);
    CHECK(nodes_at(nodes, 2) == 9);
}

TEST_CASE("nodes of a slanted cap lie on its plane, those below are spread between the caps") {
    PolygonCap slanted = top(2, {box(0, 0, 4, 2)});
    slanted.slope = {0.1, 0};
    const std::vector<Vec3> nodes = placed({bottom(0, {box(0, 0, 4, 2)}), slanted});
    REQUIRE(nodes.size() == 3 * 9);
    for (std::size_t p = 0; p < 9; ++p) {
        const Vec3& low = nodes[p];
        const Vec3& high = nodes[18 + p];
        CHECK(low[2] == 0);
        CHECK(high[2] == Approx(2 + 0.1 * high[0]));
        CHECK((nodes[9 + p] - (low + high) / 2).norm() < 1e-12);
    }
}

TEST_CASE("the frame of the body carries nodes to space") {
    PolygonBodyOptions options;
    options.frame = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    const std::vector<Vec3> flat = placed(steps());
    const std::vector<Vec3> turned = placed(steps(), options);
    REQUIRE(flat.size() == turned.size());
    for (std::size_t i = 0; i < flat.size(); ++i) {
        CHECK((turned[i] - Vec3(flat[i][2], flat[i][0], flat[i][1])).norm() < 1e-12);
    }
}
