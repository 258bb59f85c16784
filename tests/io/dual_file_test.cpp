#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/io/dual_file.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace pavior;
namespace fs = std::filesystem;

namespace {
fs::path scratch() {
    const fs::path directory = fs::temp_directory_path() / "pavior_dual_file_test";
    fs::create_directories(directory);
    return directory;
}

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++n;
    }
    return n;
}

struct Dual {
    DualSurfaces surfaces;
    RegionPolyhedra regions;
};
Dual brick() {
    const ReferenceMesh mesh = tet_meshes::read_reference("ref_brick_table52").mesh;
    const TetTopology topology = tet_topology(mesh);
    const auto contributions = add_contributions(mesh, topology, classify(mesh, topology));
    return {dual_surfaces(mesh, topology, contributions),
            region_polyhedra(mesh, topology, regions(mesh, topology, contributions))};
}
}  // namespace

TEST_CASE("surfaces and regions in one file") {
    const Dual dual = brick();
    const fs::path file = scratch() / "dual.vtu";
    write_dual(file, dual.surfaces, dual.regions);
    const std::string text = content(file);
    CHECK(count(text, "NumberOfPoints=\"704\"") == 1);  // 336 + 368
    CHECK(count(text, "NumberOfCells=\"721\"") == 1);   // 406 + 315
    for (const char* name : {"part", "colour", "region", "dimension", "rgb"}) {
        CHECK(count(text, std::string("Name=\"") + name + "\"") == 1);
    }
}

TEST_CASE("legacy files, and one part alone") {
    const Dual dual = brick();
    const fs::path file = scratch() / "DUAL.VTK";
    write_dual(file, dual.surfaces, {});
    const std::string text = content(file);
    CHECK(text.find("POINTS 336 double") != std::string::npos);
    CHECK(text.find("CELL_TYPES 406") != std::string::npos);
    write_dual(file, {}, dual.regions);
    const std::string other = content(file);
    CHECK(other.find("POINTS 368 double") != std::string::npos);
    CHECK(other.find("CELL_TYPES 315") != std::string::npos);
}

TEST_CASE("files that cannot be written leave nothing behind") {
    const Dual dual = brick();
    CHECK_THROWS_AS(write_dual((scratch() / "dual.stl").string(), dual.surfaces, dual.regions), FileError);
    CHECK_THROWS_AS(write_dual((scratch() / "missing" / "dual.vtu").string(), dual.surfaces, dual.regions), FileError);
    CHECK(!fs::exists(scratch() / "dual.stl"));
}
