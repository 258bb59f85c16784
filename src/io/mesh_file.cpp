#include <pavior/io/mesh_file.hpp>

#include <pavior/core/error.hpp>
#include <pavior/io/atomic_file.hpp>
#include <pavior/io/group_names.hpp>

#include "../common/file_extension.hpp"
#include "../common/mesh_bytes.hpp"
#include "formats.hpp"
#include "read_apart.hpp"

#include <filesystem>
#include <string>
#include <vector>

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

io::GmshVersion gmsh_version(MeshFormat format) {
    return {format == MeshFormat::msh41 || format == MeshFormat::msh41_ascii,
            format == MeshFormat::msh41 || format == MeshFormat::msh22};
}

std::string ending(MeshFormat format) {
    switch (format) {
        case MeshFormat::vtu: return ".vtu";
        case MeshFormat::vtk: return ".vtk";
        case MeshFormat::inp: return ".inp";
        default: return ".msh";
    }
}

}  // namespace

bool can_write_mesh(std::string_view file) {
    const std::string ext = detail::file_extension(file);
    return ext == ".vtu" || ext == ".vtk" || ext == ".msh" || ext == ".inp";
}

MeshFormat mesh_format(const std::string& file, MeshFormat wish) {
    if (!can_write_mesh(file)) {
        unknown_extension(file);
    }
    const std::string ext = detail::file_extension(file);
    const MeshFormat own = ext == ".vtu"   ? MeshFormat::vtu
                           : ext == ".vtk" ? MeshFormat::vtk
                           : ext == ".msh" ? MeshFormat::msh41
                                           : MeshFormat::inp;
    if (wish == MeshFormat::by_extension || wish == own) {
        return own;
    }
    if (ending(wish) != ext) {
        throw FileError(file, "the format asked for goes with files that end in " + ending(wish) + ", not in " + ext);
    }
    return wish;
}

void write_mesh(const std::string& file, const HexMeshData& data, const MeshWriteOptions& options) {
    const MeshFormat format = mesh_format(file, options.format);
    check_groups(data);
    check_ids(file, data);
    const std::vector<MeshGroup> groups = names_in_file(data, format);
    write_atomically(file, [&](const std::string& temporary) {
        io::CheckedOutput out(temporary, file);
        switch (format) {
            case MeshFormat::vtu:
            case MeshFormat::vtk: io::write_vtk(out, data, groups, format == MeshFormat::vtu); break;
            case MeshFormat::inp: io::write_abaqus(out, data, groups); break;
            default: io::write_gmsh(out, data, groups, gmsh_version(format)); break;
        }
        out.finish();
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
    if (!can_write_mesh(file)) {
        unknown_extension(file);
    }
    HexMeshData data;
    if (ext == ".inp") {
        data = io::read_abaqus(file);
    } else {
        const std::string bytes = io::read_apart(file, [&](detail::ByteWriter& writer) {
            detail::add_mesh(writer, ext == ".msh" ? io::read_gmsh(file) : io::read_vtk(file, ext == ".vtu"));
        });
        detail::ByteReader reader(bytes);
        data = detail::get_mesh(reader);
    }
    check_ids(file, data);
    return data;
}

}  // namespace pavior
