#pragma once
// A mesh with groups as bytes and back.

#include "byte_arrays.hpp"

#include <pavior/mesh/grouped_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior::detail {

/// Calls visit(array) for each array of numbers.
template <class Mesh, class Visit>
void for_arrays(Mesh& data, Visit&& visit) {
    visit(data.mesh.nodes);
    visit(data.mesh.hexes);
    visit(data.quads);
    visit(data.hex_groups);
    visit(data.quad_groups);
}

inline void add_mesh(ByteWriter& writer, const HexMeshData& data) {
    for_arrays(data, [&](const auto& array) { writer.add(array); });
    std::vector<std::array<std::int64_t, 3>> groups;  // dimension, number, length of the name
    std::string names;
    for (const MeshGroup& group : data.groups) {
        groups.push_back({group.dimension, group.number, static_cast<std::int64_t>(group.name.size())});
        names += group.name;
    }
    writer.add(groups);
    writer.add(names);
}

[[nodiscard]] inline HexMeshData get_mesh(ByteReader& reader) {
    HexMeshData data;
    for_arrays(data, [&](auto& array) { reader.get(array); });
    std::vector<std::array<std::int64_t, 3>> groups;
    std::string names;
    reader.get(groups);
    reader.get(names);
    std::size_t at = 0;
    for (const auto& [dimension, number, length] : groups) {
        const auto size = static_cast<std::size_t>(length);
        data.groups.push_back({static_cast<int>(dimension), static_cast<int>(number), names.substr(at, size)});
        at += size;
    }
    return data;
}

}  // namespace pavior::detail
