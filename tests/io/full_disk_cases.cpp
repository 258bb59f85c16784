// Every writer at every size at which the disk may be full: it says so, and leaves nothing.
#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/dual_file.hpp>
#include <pavior/io/mesh_file.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>

using namespace pavior;
namespace fs = std::filesystem;

namespace {

/// A box of n^3 hexahedra in two groups, with the quads of its bottom and top.
HexMeshData grouped_box(std::size_t n) {
    HexMeshData data;
    data.mesh = shapes::hex_box(n, n, n);
    for (std::size_t h = 0; h < data.mesh.hexes.size(); ++h) {
        data.hex_groups.push_back(h < data.mesh.hexes.size() / 2 ? 1 : 2);
    }
    for (std::size_t h = 0; h < n * n; ++h) {
        const HexCorners& c = data.mesh.hexes[h];
        data.quads.push_back({c[0], c[3], c[2], c[1]});
        data.quad_groups.push_back(5);
    }
    data.groups = {{3, 1, "lower"}, {3, 2, "upper"}, {2, 5, "floor"}};
    return data;
}

enum Outcome : int { fine = 0, silent = 1, wrong_error = 2, left_behind = 3, refused_whole = 4, wrong_size = 5 };

/// In a child: the file is written with each limit of its size. The first thing that goes wrong is the exit code.
Outcome write_with_limits(const fs::path& directory, const std::string& name, std::uintmax_t size, std::uintmax_t step,
                          const std::function<void(const std::string&)>& write) {
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string file = directory / name;
    for (std::uintmax_t limit = 0; limit < size; limit += step) {
        const rlimit soft{limit, RLIM_INFINITY};
        setrlimit(RLIMIT_FSIZE, &soft);
        try {
            write(file);
            return silent;
        } catch (const FileError& error) {
            if (std::string(error.what()).find("completely: File too large") == std::string::npos) {
                return wrong_error;
            }
        }
        if (fs::directory_iterator(directory) != fs::directory_iterator()) {
            return left_behind;
        }
    }
    const rlimit whole{size, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &whole);
    try {
        write(file);
    } catch (const FileError&) {
        return refused_whole;
    }
    return fs::file_size(file) == size ? fine : wrong_size;
}

void check_limits(const std::string& name, std::uintmax_t parts, const std::function<void(const std::string&)>& write) {
    CAPTURE(name);
    const fs::path directory = fs::temp_directory_path() / ("pavior_full_disk_" + std::to_string(getpid()));
    fs::remove_all(directory);
    fs::create_directories(directory);
    write(directory / name);
    const std::uintmax_t size = fs::file_size(directory / name);
    fs::remove(directory / name);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        _exit(write_with_limits(directory, name, size, parts == 0 ? 1 : size / parts, write));
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == fine);
    fs::remove_all(directory);
}

struct Kind {
    const char* name;
    MeshFormat format = MeshFormat::by_extension;
};
const std::vector<Kind> kinds{{"a.vtu"},
                              {"a.vtk"},
                              {"a.inp"},
                              {"a.msh"},
                              {"b.msh", MeshFormat::msh41_ascii},
                              {"c.msh", MeshFormat::msh22},
                              {"d.msh", MeshFormat::msh22_ascii}};

}  // namespace

TEST_CASE("a mesh file that is one byte too long for the disk is refused, in every format") {
    const HexMeshData data = grouped_box(1);
    for (const auto& [name, format] : kinds) {
        const MeshWriteOptions options{format};
        check_limits(name, 0, [&](const std::string& file) { write_mesh(file, data, options); });
    }
}

TEST_CASE("so is one that is larger than any buffer") {
    const HexMeshData data = grouped_box(34);
    for (const auto& [name, format] : kinds) {
        const MeshWriteOptions options{format};
        check_limits(name, 7, [&](const std::string& file) { write_mesh(file, data, options); });
    }
}

TEST_CASE("so are dual surfaces and regions") {
    const ReferenceMesh mesh = tet_meshes::read_reference("ref_brick_table52").mesh;
    const TetTopology topology = tet_topology(mesh);
    const auto contributions = add_contributions(mesh, topology, classify(mesh, topology));
    const DualSurfaces surfaces = dual_surfaces(mesh, topology, contributions);
    const RegionPolyhedra polyhedra = region_polyhedra(mesh, topology, regions(mesh, topology, contributions));
    for (const char* name : {"dual.vtu", "dual.vtk"}) {
        check_limits(name, 50, [&](const std::string& file) { write_dual(file, surfaces, polyhedra); });
    }
}
