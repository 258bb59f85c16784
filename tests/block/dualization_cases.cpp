// Whole solids by both ways of dualization: the same blocks, places and fine meshes.

#include "support/catch.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/block/dualize.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/io/surface_file.hpp>
#include <pavior/io/tet_mesh_file.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using namespace pavior;

namespace {

std::vector<std::string> files(const std::string& directory, const std::string& extension) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
        if (entry.path().extension() == extension) {
            names.push_back(entry.path().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

void check_both_ways(const ReferenceMesh& mesh) {
    BlockOptions options;
    options.refine.emplace();
    const SolidBlocks complex = block_solid(mesh, options);
    options.dualization = Dualization::contributions;
    const SolidBlocks published = block_solid(mesh, options);
    REQUIRE(complex.report.dual.valid());
    REQUIRE(published.report.dual.valid());
    CHECK(complex.report.marking.quality == published.report.marking.quality);
    CHECK(complex.reference.nodes == published.reference.nodes);
    CHECK(complex.blocks.nodes == published.blocks.nodes);
    CHECK(complex.blocks.hexes == published.blocks.hexes);
    CHECK(complex.blocks.quads == published.blocks.quads);
    CHECK(complex.blocks.sheets == published.blocks.sheets);
    CHECK(complex.placement.positions == published.placement.positions);
    REQUIRE(published.fine);
    CHECK(complex.fine->mesh.nodes == published.fine->mesh.nodes);
    CHECK(complex.fine->mesh.hexes == published.fine->mesh.hexes);
    CHECK(complex.fine->boundary == published.fine->boundary);
}

}  // namespace

TEST_CASE("contributions give the blocks of the cell complex: surfaces", "[dualization]") {
    const std::vector<std::string> names = files(std::string(PAVIOR_TEST_DATA) + "/block", ".off");
    REQUIRE(names.size() == 12);
    for (const std::string& name : names) {
        INFO(name);
        TetOptions options;
        options.time_limit = 60;
        check_both_ways(make_reference_mesh(tetrahedralize(read_surface(name), options).mesh));
    }
}

TEST_CASE("contributions give the blocks of the cell complex: tetrahedra", "[dualization]") {
    const std::vector<std::string> names = files(std::string(PAVIOR_EXAMPLE_DATA) + "/mc3d", ".vtk");
    REQUIRE(names.size() == 5);
    for (const std::string& name : names) {
        INFO(name);
        check_both_ways(make_reference_mesh(read_tet_mesh(name)));
    }
}
