#pragma once
/// \file
/// Hexahedra with named groups: what mesh files hold.

#include <pavior/mesh/span_mesh.hpp>

#include <cstdint>
#include <string>
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

}  // namespace pavior
