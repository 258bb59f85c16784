#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/mesh_access.hpp>

#include <string>

using namespace pavior;

static_assert(quad_mesh<archetype::Quads> && vertex_mesh<archetype::Quads> && !hex_mesh<archetype::Quads>);
static_assert(hex_mesh<archetype::Hexes> && vertex_mesh<archetype::Hexes> && !quad_mesh<archetype::Hexes>);
static_assert(quad_mesh<const archetype::Quads&>);
static_assert(!vertex_mesh<int> && !quad_mesh<std::string>);

TEST_CASE("an archetype is read through its access alone") {
    const archetype::Quads quads(shapes::grid_cap(2, 1));
    CHECK(node_count(quads) == 6);
    CHECK(node(quads, 1) == Vec3(0, -1, 0));
    CHECK(quad_count(quads) == 2);
    CHECK(quad(quads, 1) == QuadCorners{1, 2, 5, 4});

    const archetype::Hexes hexes(shapes::hex_box(1, 1, 2));
    CHECK(node_count(hexes) == 12);
    CHECK(node(hexes, 4) == Vec3(0, 0, 0.5));
    CHECK(hex_count(hexes) == 2);
    CHECK(hex(hexes, 1) == HexCorners{4, 5, 7, 6, 8, 9, 11, 10});
}
