#include <pavior/io/mesh_file.hpp>

#include <pavior/core/error.hpp>
#include <pavior/io/atomic_file.hpp>

#include "../common/file_extension.hpp"
#include "formats.hpp"

#include <filesystem>

namespace pavior {

namespace {

namespace fs = std::filesystem;

void check_groups(const HexMeshData& data) {
    const auto fits = [](std::size_t groups, std::size_t cells) { return groups == 0 || groups == cells; };
    if (!fits(data.hex_groups.size(), data.mesh.hexes.size()) || !fits(data.quad_groups.size(), data.quads.size())) {
        throw InputError(ErrorCode::size_mismatch, "the group arrays do not have one entry a cell");
    }
}

void check_ids(const std::string& file, const HexMeshData& data) {
    const auto check = [&](const auto& cells, const char* kind) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const Index node : cells[i]) {
                if (node >= data.mesh.nodes.size()) {
                    throw FileError(file,
                                    std::string(kind) + " " + std::to_string(i) + " names a node that does not exist",
                                    {static_cast<std::int64_t>(i)});
                }
            }
        }
    };
    check(data.mesh.hexes, "hexahedron");
    check(data.quads, "quad");
}

[[noreturn]] void unknown_extension(const std::string& file) {
    throw FileError(file, "unknown mesh format; known are .vtu .vtk .msh .inp");
}

}  // namespace

bool can_write_mesh(std::string_view file) {
    const std::string ext = detail::file_extension(file);
    return ext == ".vtu" || ext == ".vtk" || ext == ".msh" || ext == ".inp";
}

void write_mesh(const std::string& file, const HexMeshData& data) {
    if (!can_write_mesh(file)) {
        unknown_extension(file);
    }
    check_groups(data);
    const std::string ext = detail::file_extension(file);
    write_atomically(file, [&](const std::string& temporary) {
        if (ext == ".msh") {
            io::write_gmsh(temporary, data);
        } else if (ext == ".inp") {
            io::write_abaqus(temporary, data);
        } else {
            io::write_vtk(temporary, data, ext == ".vtu");
        }
    });
}

HexMeshData read_mesh(const std::string& file) {
    std::error_code error;
    if (!fs::exists(file, error)) {
        throw FileError(file, "no such file");
    }
    if (fs::is_directory(file, error)) {
        throw FileError(file, "is a directory");
    }
    const std::string ext = detail::file_extension(file);
    HexMeshData data = [&] {
        if (ext == ".msh") {
            return io::read_gmsh(file);
        }
        if (ext == ".inp") {
            return io::read_abaqus(file);
        }
        if (ext == ".vtu" || ext == ".vtk") {
            return io::read_vtk(file, ext == ".vtu");
        }
        unknown_extension(file);
    }();
    check_ids(file, data);
    return data;
}

}  // namespace pavior
