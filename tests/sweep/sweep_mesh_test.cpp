#include "support/catch.hpp"

#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/sweep/sweep_mesh.hpp>

#include <vector>

using namespace pavior;

static_assert(hex_mesh<SweepMesh>);

namespace {
// Two quads side by side, three layers.
SweepMesh bar() {
    std::vector<Vec3> nodes;
    for (int k = 0; k <= 3; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 3; ++i) {
                nodes.emplace_back(i, j, k);
            }
        }
    }
    return {nodes, {{0, 1, 4, 3}, {1, 2, 5, 4}}, 3};
}
}  // namespace

TEST_CASE("nodes and hexahedra are numbered level by level in source order") {
    const SweepMesh mesh = bar();
    CHECK(mesh.level_size() == 6);
    CHECK(mesh.layer_count() == 3);
    CHECK(mesh.hex_count() == 6);
    CHECK(mesh.level(2)[4] == Vec3(1, 1, 2));
    CHECK(mesh.numbering().node(2, 4) == 16);
    CHECK(mesh.hex(0) == HexCorners{0, 1, 4, 3, 6, 7, 10, 9});
    CHECK(mesh.hex(5) == HexCorners{13, 14, 17, 16, 19, 20, 23, 22});
    const std::vector<HexCorners> all = mesh.hexes();
    REQUIRE(all.size() == 6);
    for (std::size_t h = 0; h < 6; ++h) {
        CHECK(all[h] == mesh.hex(h));
    }
}

TEST_CASE("it is a hexahedral mesh like any other") {
    const SweepMesh mesh = bar();
    CHECK(node_count(mesh) == 24);
    CHECK(hex_count(mesh) == 6);
    CHECK(hex(mesh, 3) == mesh.hex(3));
    CHECK(node(mesh, 7) == Vec3(1, 0, 1));
    CHECK(verify_hexes(mesh).ok());
}

TEST_CASE("wrong sizes are refused") {
    CHECK_THROWS_AS(SweepMesh(std::vector<Vec3>(7), {}, 2), InputError);
    CHECK_THROWS_AS((SweepNumbering{100000, 50000}.check(1)), InputError);
    CHECK_THROWS_AS((SweepNumbering{10, 100000}.check(100000)), InputError);
    CHECK_NOTHROW((SweepNumbering{100000, 200}.check(100000)));
    CHECK(SweepMesh().hex_count() == 0);
}
