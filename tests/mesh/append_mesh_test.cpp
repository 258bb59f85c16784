#include <pavior/mesh/append_mesh.hpp>

#include "support/catch.hpp"

using namespace pavior;

TEST_CASE("ids are moved behind the nodes that are there") {
    const HexMesh cube{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                       {{0, 1, 2, 3, 4, 5, 6, 7}}};
    const std::vector<QuadCorners> floor{{0, 3, 2, 1}};
    HexMesh mesh;
    std::vector<QuadCorners> quads;
    append_mesh(cube, floor, mesh, quads);
    CHECK(mesh.nodes == cube.nodes);
    CHECK(mesh.hexes == cube.hexes);
    CHECK(quads == floor);
    append_mesh(cube, floor, mesh, quads);
    CHECK(mesh.nodes.size() == 16);
    CHECK(mesh.hexes.back() == HexCorners{8, 9, 10, 11, 12, 13, 14, 15});
    CHECK(quads.back() == QuadCorners{8, 11, 10, 9});
    append_mesh({}, {}, mesh, quads);
    CHECK(mesh.hexes.size() == 2);
}
