#pragma once
// The formats behind mesh_file.hpp, one pair of functions each. Writers get a file open in its temporary place, and the
// groups with the names of names_in_file(); mesh_file.cpp finishes and renames it.

#include "checked_output.hpp"

#include <pavior/io/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pavior::io {

void write_vtk(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups, bool xml);
HexMeshData read_vtk(const std::string& file, bool xml);

struct GmshVersion {
    bool is_41 = true;  ///< else 2.2
    bool binary = true;
};
void write_gmsh(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups, GmshVersion version);
HexMeshData read_gmsh(const std::string& file);

void write_abaqus(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups);
HexMeshData read_abaqus(const std::string& file);

/// Group of cell i; 0 where the array is empty.
inline int group_of(const std::vector<std::int32_t>& groups, std::size_t i) { return groups.empty() ? 0 : groups[i]; }

/// Cells of each group number, ascending.
inline std::map<int, std::vector<std::size_t>> cells_by_group(std::size_t count,
                                                              const std::vector<std::int32_t>& groups) {
    std::map<int, std::vector<std::size_t>> result;
    for (std::size_t i = 0; i < count; ++i) {
        result[group_of(groups, i)].push_back(i);
    }
    return result;
}

/// The name of a group, empty where it has none.
inline std::string name_of(const std::vector<MeshGroup>& groups, int dimension, int number) {
    for (const MeshGroup& group : groups) {
        if (group.dimension == dimension && group.number == number) {
            return group.name;
        }
    }
    return {};
}

}  // namespace pavior::io
