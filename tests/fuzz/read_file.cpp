// A reader and a file of any bytes: it answers with data that hold together, or with an error of ours.
#include "bytes.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/io/surface_file.hpp>
#include <pavior/io/sweep_problem_file.hpp>
#include <pavior/io/tet_mesh_file.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

using namespace pavior;

namespace {

/// A file in memory where there is one.
const std::string& scratch() {
    static const std::string name = std::string(::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp") +
                                    "/pavior_fuzz_" + std::to_string(::getpid()) + PAVIOR_FUZZ_EXTENSION;
    static const int registered = std::atexit([] { std::remove(name.c_str()); });
    fuzz::require(registered == 0);
    return name;
}

template <class Cells>
void require_ids(const Cells& cells, std::size_t nodes) {
    for (const auto& cell : cells) {
        for (const Index i : cell) {
            fuzz::require(i < nodes);
        }
    }
}

void read(const std::string& file) {
#if defined PAVIOR_FUZZ_SURFACE
    const TaggedSurface surface = read_surface(file);
    require_ids(surface.mesh.triangles, surface.mesh.nodes.size());
    fuzz::require(surface.face_tags.empty() || surface.face_tags.size() == surface.mesh.triangles.size());
#elif defined PAVIOR_FUZZ_TETS
    const TaggedTetMesh tets = read_tet_mesh(file);
    require_ids(tets.mesh.tets, tets.mesh.nodes.size());
#elif defined PAVIOR_FUZZ_MESH
    const HexMeshData data = read_mesh(file);
    require_ids(data.mesh.hexes, data.mesh.nodes.size());
    require_ids(data.quads, data.mesh.nodes.size());
#else
    const SweepProblem problem = read_sweep_problem(file);
    fuzz::require(problem.boundary_levels.size() == (problem.layers + 1) * problem.loops.nodes.size());
#endif
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::FILE* file = std::fopen(scratch().c_str(), "wb");
    fuzz::require(file != nullptr && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0);
    try {
        read(scratch());
    } catch (const Error&) {
    }
    return 0;
}
