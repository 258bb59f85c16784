#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/caps_over_cells.hpp>
#include <pavior/many_to_many/detail/layered_hex_builder.hpp>
#include <pavior/many_to_many/layered_hexes.hpp>
#include <pavior/many_to_many/plane_intervals.hpp>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("columns over steps: hexahedra, caps and sides of each layer") {
    const PolygonBody body(steps());
    ExtrudedBody named = body.body();
    named.sides.push_back({{7, 9}, 77});  // the riser x = 2, from cap 1 to cap 2
    const PlaneArrangement plane = arranged(body);
    const std::vector<CapsOverCell> stacks = caps_over_cells(body.body(), body, plane).stacks;
    const CapLevels levels{{0, 1, 2}, std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}, {}, 2, 1, true};
    const std::vector<char> wanted(2, 1);
    const PlaneMesh quads = mesh_plane(
        plane, std::vector<int>(plane.edges.size(), 2), wanted, [](Index, const Vec2& x) { return x; },
        GmshRegionMesher{}, [](Index, const Error& error) { throw error; });
    detail::LayeredHexBuilder builder(named, plane, quads, stacks, levels);
    const LayeredHexes& mesh = builder.result();
    CHECK(mesh.mesh.hexes.size() == 12);
    CHECK(mesh.mesh.nodes.size() == 15 + 15 + 9);
    CHECK(std::count(mesh.quad_surface.begin(), mesh.quad_surface.end(), 0U) == 8);
    CHECK(std::count(mesh.quad_surface.begin(), mesh.quad_surface.end(), 2U) == 4);
    CHECK(std::count(mesh.quad_surface.begin(), mesh.quad_surface.end(), 3U) == 2);  // the riser
    CHECK(mesh.quads.size() == 16 + 12 + 8);
    CHECK(std::count(mesh.hex_solid.begin(), mesh.hex_solid.end(), 0U) == 12);
}
