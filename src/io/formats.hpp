#pragma once
// The formats behind mesh_file.hpp, one pair of functions each. Writers write in place; mesh_file.cpp renames.

#include <pavior/io/mesh_file.hpp>

#include <map>
#include <string>

namespace pavior::io {

void write_vtk(const std::string& file, const HexMeshData& data, bool xml);
HexMeshData read_vtk(const std::string& file, bool xml);

void write_gmsh(const std::string& file, const HexMeshData& data);
HexMeshData read_gmsh(const std::string& file);

void write_abaqus(const std::string& file, const HexMeshData& data);
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

}  // namespace pavior::io
