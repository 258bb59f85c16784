#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/outward_quads.hpp>

#include <algorithm>

using namespace pavior;

namespace {

/// Two cubes above each other, the lower one in group \p low.
HexMeshData two_cubes(int low, int high) {
    HexMeshData data;
    data.mesh = shapes::hex_box(1, 1, 2);
    data.hex_groups = {low, high};
    return data;
}

QuadCorners turned(const QuadCorners& q) { return {q[0], q[3], q[2], q[1]}; }

}  // namespace

TEST_CASE("quads are found on the faces of hexahedra, whatever their sense") {
    const HexMeshData data = two_cubes(1, 2);
    const QuadCorners top = hex_face(data.mesh.hexes[0], 1);
    const std::vector<QuadCorners> quads{top, turned(top), hex_face(data.mesh.hexes[1], 3), {0, 1, 2, 11}};
    const auto faces = faces_under_quads(data.mesh, quads);
    REQUIRE(faces.size() == 4);
    for (const std::size_t q : {std::size_t{0}, std::size_t{1}}) {
        CHECK(faces[q][0] == HexFace{0, 1});
        CHECK(faces[q][1] == HexFace{1, 0});
    }
    CHECK(faces[2][0] == HexFace{1, 3});
    CHECK(faces[2][1].hex == no_index);
    CHECK(faces[3][0].hex == no_index);
    CHECK(faces_under_quads(data.mesh, {}).empty());
    const archetype::Hexes foreign(data.mesh);
    CHECK(faces_under_quads(foreign, quads) == faces);
}

TEST_CASE("outer quads are turned outward, and those that are keep their bytes") {
    for (const bool inward : {false, true}) {
        HexMeshData data = two_cubes(1, 2);
        for (std::size_t h = 0; h < 2; ++h) {
            for (std::size_t f = 0; f < 6; ++f) {
                if (h + f != 1) {  // not the one between them
                    QuadCorners quad = hex_face(data.mesh.hexes[h], f);
                    std::rotate(quad.begin(), quad.begin() + static_cast<std::ptrdiff_t>(f % 4), quad.end());
                    data.quads.push_back(inward ? turned(quad) : quad);
                }
            }
        }
        const std::vector<QuadCorners> before = data.quads;
        turn_quads_outward(data);
        for (std::size_t q = 0; q < before.size(); ++q) {
            CHECK(data.quads[q] == (inward ? turned(before[q]) : before[q]));
        }
    }
}

TEST_CASE("a quad between two groups looks out of the lower one, wherever it stands") {
    for (const auto& [low, high] : {std::pair{1, 2}, {2, 1}, {7, 7}}) {
        HexMeshData data = two_cubes(low, high);
        const QuadCorners up = hex_face(data.mesh.hexes[0], 1);
        data.quads = {up, turned(up), {0, 1, 2, 11}};
        turn_quads_outward(data);
        CHECK(data.quads[0] == (low <= high ? up : turned(up)));
        CHECK(data.quads[1] == (low < high ? up : turned(up)));
        CHECK(data.quads[2] == QuadCorners{0, 1, 2, 11});
    }
}

TEST_CASE("without groups only outer quads are turned") {
    HexMeshData data = two_cubes(0, 0);
    data.hex_groups.clear();
    const QuadCorners up = hex_face(data.mesh.hexes[0], 1);
    const QuadCorners side = hex_face(data.mesh.hexes[0], 2);
    data.quads = {turned(up), turned(side)};
    turn_quads_outward(data);
    CHECK(data.quads == std::vector<QuadCorners>{turned(up), side});
}
