#pragma once
/// \file
/// Mesh files: hexahedra with groups, in and out. Formats are VTK's and Gmsh's own writers and readers.

#include <pavior/mesh/grouped_mesh.hpp>

#include <string>
#include <string_view>

namespace pavior {

/// True if write_mesh() knows the extension of \p file: .vtu .vtk .msh .inp (any case).
[[nodiscard]] bool can_write_mesh(std::string_view file);

/// Writes \p data to \p file; the format follows the extension:
///   .vtu  VTK XML, appended binary; cell array "group", names in the field array "group_names"
///   .vtk  VTK legacy, binary; same arrays
///   .msh  Gmsh 4.1, binary; groups become physical groups
///   .inp  Abaqus, 17 digits; groups become element sets
/// Nodes keep their order (in .msh and .inp node i has tag i + 1) and coordinates their 64 bits.
/// The file appears whole or not at all: it is written beside its place and renamed.
/// \throws FileError (unknown extension, directory missing or not writable), InputError (size_mismatch of the groups)
void write_mesh(const std::string& file, const HexMeshData& data);

/// The same for the hexahedra of any hex_mesh, without quads and groups.
template <hex_mesh M>
void write_mesh(const std::string& file, const M& mesh) {
    write_mesh(file, HexMeshData{to_hex_mesh(mesh), {}, {}, {}, {}});
}

/// Reads the linear hexahedra (and quads) of \p file: .vtu .vtk .msh .inp. Other volume cells are refused, since they
/// could not be judged; lines, points and triangles are skipped.
/// \throws FileError naming the file and what is wrong with it
[[nodiscard]] HexMeshData read_mesh(const std::string& file);

}  // namespace pavior
