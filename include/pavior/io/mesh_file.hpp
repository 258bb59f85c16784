#pragma once
/// \file
/// Mesh files: hexahedra with groups, in and out. Formats are VTK's and Gmsh's own writers and readers.

#include <pavior/mesh/span_mesh.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// A named set of cells; cells carry the group's number in HexMeshData::hex_groups or quad_groups.
struct MeshGroup {
    int dimension = 3;  ///< 3 for hexahedra, 2 for boundary quads
    int number = 0;     ///< unique for the dimension, >= 1
    std::string name;   ///< may be empty

    friend bool operator==(const MeshGroup&, const MeshGroup&) = default;
};

/// What a mesh file holds: hexahedra, optionally boundary quads, and the group of each.
struct HexMeshData {
    HexMesh mesh;
    std::vector<QuadCorners> quads;         ///< quads of the boundary and of interfaces, may be empty
    std::vector<std::int32_t> hex_groups;   ///< a group number a hexahedron, or empty
    std::vector<std::int32_t> quad_groups;  ///< a group number a quad, or empty
    std::vector<MeshGroup> groups;          ///< names of the numbers in use
};

/// The name of a group, empty where it has none. O(groups).
[[nodiscard]] inline std::string group_name(const HexMeshData& data, int dimension, int number) {
    for (const MeshGroup& group : data.groups) {
        if (group.dimension == dimension && group.number == number) {
            return group.name;
        }
    }
    return {};
}

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

/// Reads the linear hexahedra (and quads) of \p file: .vtu .vtk .msh .inp. Other volume cells are refused, since they
/// could not be judged; lines, points and triangles are skipped.
/// \throws FileError naming the file and what is wrong with it
[[nodiscard]] HexMeshData read_mesh(const std::string& file);

}  // namespace pavior
