#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/mesh_file.hpp>

#include <unistd.h>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

using namespace pavior;
namespace fs = std::filesystem;

namespace {

fs::path scratch() {
    const fs::path directory = fs::temp_directory_path() / "pavior_mesh_file_test";
    fs::create_directories(directory);
    return directory;
}

/// Two hexahedra in two groups, with coordinates that need all 17 digits, and two quads.
HexMeshData two_hexes() {
    HexMeshData data;
    for (int k = 0; k < 3; ++k) {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            data.mesh.nodes.emplace_back(x / 3.0, std::sqrt(2.0) * y, 1e-3 * k + 0.1 * k);
        }
    }
    data.mesh.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}};
    data.quads = {{0, 3, 2, 1}, {8, 9, 10, 11}};
    data.hex_groups = {7, 9};
    data.quad_groups = {1, 2};
    data.groups = {{3, 7, "bolt"}, {3, 9, "washer"}, {2, 1, "bottom"}, {2, 2, "top"}};
    return data;
}

/// Group names per cell: formats are free to renumber groups, not to rename them.
std::vector<std::string> names(const HexMeshData& data, int dimension) {
    std::vector<std::string> result;
    for (const int number : dimension == 3 ? data.hex_groups : data.quad_groups) {
        for (const MeshGroup& group : data.groups) {
            if (group.dimension == dimension && group.number == number) {
                result.push_back(group.name);
            }
        }
    }
    return result;
}

}  // namespace

TEST_CASE("every format keeps the bits of coordinates, the order of nodes and cells, and the groups") {
    const HexMeshData data = two_hexes();
    for (const char* name : {"a.vtu", "a.vtk", "a.msh", "a.inp", "UPPER.VTU"}) {
        CAPTURE(name);
        const std::string file = scratch() / name;
        write_mesh(file, data);
        const HexMeshData back = read_mesh(file);
        REQUIRE(back.mesh.nodes.size() == data.mesh.nodes.size());
        for (std::size_t i = 0; i < data.mesh.nodes.size(); ++i) {
            CHECK(std::memcmp(back.mesh.nodes[i].data(), data.mesh.nodes[i].data(), 3 * sizeof(double)) == 0);
        }
        CHECK(back.mesh.hexes == data.mesh.hexes);
        CHECK(back.quads == data.quads);
        CHECK(names(back, 3) == names(data, 3));
        CHECK(names(back, 2) == names(data, 2));
    }
}

TEST_CASE("a mesh without groups and quads survives too") {
    HexMeshData data = two_hexes();
    data.quads.clear();
    data.quad_groups.clear();
    data.hex_groups.clear();
    data.groups.clear();
    for (const char* name : {"b.vtu", "b.vtk", "b.msh", "b.inp"}) {
        const std::string file = scratch() / name;
        write_mesh(file, data);
        CHECK(read_mesh(file).mesh.hexes == data.mesh.hexes);
    }
}

TEST_CASE("a file appears whole or not at all") {
    const HexMeshData data = two_hexes();
    CHECK_THROWS_AS(write_mesh(scratch() / "no_such_directory" / "a.vtu", data), FileError);
    CHECK_THROWS_AS(write_mesh(scratch() / "a.stl", data), FileError);
    HexMeshData wrong = data;
    wrong.hex_groups.pop_back();
    fs::remove(scratch() / "c.vtu");
    CHECK_THROWS_AS(write_mesh(scratch() / "c.vtu", wrong), InputError);
    CHECK_FALSE(fs::exists(scratch() / "c.vtu"));
    for (const auto& entry : fs::directory_iterator(scratch())) {
        CHECK(entry.path().filename().string().find(".part") == std::string::npos);
    }
}

TEST_CASE("unreadable files are named") {
    const auto write_text = [](const fs::path& file, const std::string& text) { std::ofstream(file) << text; };
    CHECK_THROWS_WITH(read_mesh(scratch() / "missing.vtu"), Catch::Contains("missing.vtu"));
    CHECK_THROWS_AS(read_mesh(scratch()), FileError);
    for (const char* name : {"garbage.vtu", "garbage.vtk", "garbage.msh", "garbage.inp"}) {
        CAPTURE(name);
        write_text(scratch() / name, "this is not a mesh\n1 2 3\n");
        CHECK_THROWS_WITH(read_mesh(scratch() / name), Catch::Contains(name));
        write_text(scratch() / name, "");
        CHECK_THROWS_WITH(read_mesh(scratch() / name), Catch::Contains(name));
    }
    write_text(scratch() / "tet.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n");
    CHECK_THROWS_WITH(read_mesh(scratch() / "tet.inp"), Catch::Contains("C3D4"));
    write_text(scratch() / "id.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n");
    CHECK_THROWS_WITH(read_mesh(scratch() / "id.inp"), Catch::Contains("node 2"));
}

TEST_CASE("any hexahedral mesh is written, without groups") {
    const HexMesh box = shapes::hex_box(2, 1, 2);  // halves are floats
    for (const char* name : {"any.vtu", "any.msh", "any.inp"}) {
        CAPTURE(name);
        const std::string file = scratch() / name;
        write_mesh(file, archetype::Hexes(box));
        const HexMeshData back = read_mesh(file);
        CHECK(back.mesh.nodes == box.nodes);
        CHECK(back.mesh.hexes == box.hexes);
        CHECK(back.quads.empty());
    }
    const std::vector<std::array<int, 8>> cells{{0, 1, 2, 3, 4, 5, 6, 7}};
    const std::array<std::array<double, 3>, 8> points{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    write_mesh(scratch() / "view.vtk", HexMeshView{points, cells});
    CHECK(read_mesh(scratch() / "view.vtk").mesh.nodes[6] == Vec3(1, 1, 1));
}
