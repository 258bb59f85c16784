#pragma once
/// \file
/// Mesh files: hexahedra with groups, in and out. Reading .msh is Gmsh's, .vtu and .vtk are VTK's; the rest is ours.

#include <pavior/mesh/grouped_mesh.hpp>

#include <string>
#include <string_view>

namespace pavior {

/// What write_mesh() writes.
enum class MeshFormat {
    by_extension,  ///< by the ending of the file; .msh: msh41
    vtu,           ///< .vtu: VTK XML, appended binary
    vtk,           ///< .vtk: VTK legacy, binary
    msh41,         ///< .msh: Gmsh 4.1, binary
    msh41_ascii,   ///< .msh: Gmsh 4.1, text; coordinates with the digits that give them back exactly
    msh22,         ///< .msh: Gmsh 2.2, binary
    msh22_ascii,   ///< .msh: Gmsh 2.2, text
    inp            ///< .inp: Abaqus, 17 digits
};

/// How write_mesh() works.
struct MeshWriteOptions {
    MeshFormat format = MeshFormat::by_extension;
};

/// True if write_mesh() knows the extension of \p file: .vtu .vtk .msh .inp (any case).
[[nodiscard]] bool can_write_mesh(std::string_view file);

/// The format that write_mesh() takes for \p file: \p wish, or the one of the ending. Never by_extension.
/// \throws FileError (unknown ending, or one that \p wish does not go with)
[[nodiscard]] MeshFormat mesh_format(const std::string& file, MeshFormat wish = MeshFormat::by_extension);

/// Writes \p data to \p file; the format follows the extension, or \p options:
///   .vtu  VTK XML; cell array "group"; for every group with a name a field array of that name: number, dimension
///   .vtk  VTK legacy; same arrays
///   .msh  groups become physical groups
///   .inp  element sets, node sets of their nodes, and for groups of quads a *SURFACE of the faces of hexahedra under
///         them, all of the same name
/// Names of groups are made legal and unique, see names_in_file(). Nodes keep their order (in .msh and .inp node i has
/// tag i + 1) and coordinates their 64 bits. The file appears whole or not at all: it is written beside its place and
/// renamed.
/// \throws FileError (unknown extension, directory missing or not writable, disk full, a cell with a node that does not
///         exist), InputError (size_mismatch of the groups)
void write_mesh(const std::string& file, const HexMeshData& data, const MeshWriteOptions& options = {});

/// The same for the hexahedra of any hex_mesh, without quads and groups.
template <hex_mesh M>
void write_mesh(const std::string& file, const M& mesh, const MeshWriteOptions& options = {}) {
    write_mesh(file, HexMeshData{to_hex_mesh(mesh), {}, {}, {}, {}}, options);
}

/// Reads the linear hexahedra (and quads) of \p file: .vtu .vtk .msh .inp. Other volume cells are refused, since they
/// could not be judged; lines, points and triangles are skipped. Gmsh and VTK, which crash or hang on broken files,
/// read in a process of their own; it is given up after 10 s and one more for each 100 kB.
/// \throws FileError naming the file and what is wrong with it
[[nodiscard]] HexMeshData read_mesh(const std::string& file);

}  // namespace pavior
