#include "support/catch.hpp"

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cstddef>
#include <vector>

using namespace pavior;

namespace {

/// A cube [x, x + 1] x [0, 1]^2 with its lower and upper face.
SolidsMesh cube(double x, std::int32_t solid) {
    SolidsMesh result;
    for (const double z : {0.0, 1.0}) {
        for (const Vec2& p : {Vec2(x, 0), Vec2(x + 1, 0), Vec2(x + 1, 1), Vec2(x, 1)}) {
            result.mesh.nodes.emplace_back(p[0], p[1], z);
        }
    }
    result.mesh.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}};
    result.hex_solid = {SolidId{solid}};
    result.quads = {{0, 3, 2, 1}, {4, 5, 6, 7}};
    result.quad_face = {FaceId{2 * solid}, FaceId{2 * solid + 1}};
    return result;
}

}  // namespace

TEST_CASE("Meshes of solids are appended with their entities") {
    SolidsMesh mesh = cube(0, 0);
    append_solids(cube(3, 1), mesh);
    CHECK(verify_hexes(mesh.mesh).ok());
    CHECK(mesh.mesh.nodes.size() == 16);
    CHECK(mesh.mesh.nodes[8] == Vec3(3, 0, 0));
    CHECK(mesh.mesh.hexes.at(1) == HexCorners{8, 9, 10, 11, 12, 13, 14, 15});
    CHECK(mesh.hex_solid == std::vector<SolidId>{SolidId{0}, SolidId{1}});
    CHECK(mesh.quads.at(2) == QuadCorners{8, 11, 10, 9});
    CHECK(mesh.quad_face == std::vector<FaceId>{FaceId{0}, FaceId{1}, FaceId{2}, FaceId{3}});

    SolidsMesh empty;
    append_solids(cube(0, 0), empty);
    append_solids({}, empty);
    CHECK(empty.mesh.hexes == cube(0, 0).mesh.hexes);
    CHECK(empty.quads == cube(0, 0).quads);
}

TEST_CASE("A mesh that was made on the nodes of another extends it") {
    SolidsMesh mesh = cube(0, 0);
    SolidsMesh beside = cube(1, 1);  // on the face x = 1 of the first
    beside.mesh.nodes = mesh.mesh.nodes;
    for (const Vec3& p : {Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(2, 0, 1), Vec3(2, 1, 1)}) {
        beside.mesh.nodes.push_back(p);
    }
    beside.mesh.hexes = {{1, 8, 9, 2, 5, 10, 11, 6}};
    beside.quads = {{1, 2, 9, 8}, {5, 10, 11, 6}};
    extend_solids(beside, mesh);
    CHECK(verify_hexes(mesh.mesh).ok());
    CHECK(mesh.mesh.nodes.size() == 12);
    CHECK(mesh.mesh.hexes.size() == 2);
    CHECK(mesh.hex_solid == std::vector<SolidId>{SolidId{0}, SolidId{1}});
    CHECK(mesh.quads.size() == 4);
    CHECK(mesh.quads[3] == QuadCorners{5, 10, 11, 6});
    CHECK(mesh.quad_face.back() == FaceId{3});
}
