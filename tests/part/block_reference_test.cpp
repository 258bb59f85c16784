#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/part/block_reference.hpp>

#include <set>
#include <string>

using namespace pavior;

TEST_CASE("CAD models, surfaces and tetrahedra become reference meshes, with the tags that they have") {
    const BlockReference cad = read_block_reference(std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/2-6-19.step");
    CHECK(cad.cad);
    CHECK(std::set(cad.surface.face_tags.begin(), cad.surface.face_tags.end()).size() == 12);
    CHECK_FALSE(cad.mesh.tets.empty());
    const BlockReference off = read_block_reference(std::string(PAVIOR_TEST_DATA) + "/block/c01_brick_tapered.off");
    CHECK_FALSE(off.cad);
    CHECK_FALSE(off.mesh.tets.empty());
    const BlockReference tets = read_block_reference(std::string(PAVIOR_EXAMPLE_DATA) + "/mc3d/hexme_s01c_cube_MC.vtk");
    CHECK_FALSE(tets.mesh.tets.empty());
    CHECK(tets.surface.mesh.triangles.size() == tets.surface.face_tags.size());
}

TEST_CASE("A finer size makes triangles follow curved faces more closely") {
    const std::string file = std::string(PAVIOR_EXAMPLE_DATA) + "/hexme/s11o_cube_cyl.stp";
    const std::size_t coarse = read_block_reference(file).surface.mesh.triangles.size();
    CHECK(read_block_reference(file, {.size = 0.05}).surface.mesh.triangles.size() > coarse);
}

TEST_CASE("Files of no known kind are refused by name") {
    CHECK_THROWS_WITH(read_block_reference("part.xyz"), Catch::Contains("part.xyz") && Catch::Contains(".step"));
    CHECK_THROWS_AS(read_block_reference("no_such.off"), FileError);
}
