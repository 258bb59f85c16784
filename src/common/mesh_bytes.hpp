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

inline void add_mesh(ByteWriter& writer, const HexMeshData& data) {
    writer.add(data.mesh.nodes);
    writer.add(data.mesh.hexes);
    writer.add(data.quads);
    writer.add(data.hex_groups);
    writer.add(data.quad_groups);
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
    reader.get(data.mesh.nodes);
    reader.get(data.mesh.hexes);
    reader.get(data.quads);
    reader.get(data.hex_groups);
    reader.get(data.quad_groups);
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
