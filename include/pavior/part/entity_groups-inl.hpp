#pragma once

#include <pavior/mesh/outward_quads.hpp>
#include <pavior/part/entity_groups.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace pavior {

PAVIOR_INLINE std::vector<MeshGroup> entity_groups(const AnyModel& b, std::span<const SolidId> solids) {
    const auto name = [](const std::string& label, const char* kind, int tag) {
        return label.empty() ? kind + std::to_string(tag) : label;
    };
    std::vector<MeshGroup> groups;
    std::set<std::size_t> faces;
    std::set<std::pair<int, int>> known;  // pieces of one entity of the file are one group
    const auto add = [&](int dimension, int tag, std::string text) {
        if (known.emplace(dimension, tag).second) {
            groups.push_back({dimension, tag, std::move(text)});
        }
    };
    for (const SolidId solid : solids) {
        const int tag = b.tag(3, solid.index());
        add(3, tag, name(name_of(b, solid), "solid_", tag));
        for (const OrientedFace& face : b.solid_faces(solid)) {
            faces.insert(face.face.index());
        }
    }
    for (const std::size_t f : faces) {
        const int tag = b.tag(2, f);
        add(2, tag, name(name_of(b, FaceId{static_cast<std::int32_t>(f)}), "face_", tag));
    }
    return groups;
}

PAVIOR_INLINE HexMeshData grouped(const AnyModel& b, std::span<const SolidId> solids, SolidsMesh mesh) {
    HexMeshData data;
    data.mesh = std::move(mesh.mesh);
    data.quads = std::move(mesh.quads);
    for (const SolidId solid : mesh.hex_solid) {
        data.hex_groups.push_back(b.tag(3, solid.index()));
    }
    for (const FaceId face : mesh.quad_face) {
        data.quad_groups.push_back(b.tag(2, face.index()));
    }
    data.groups = entity_groups(b, solids);
    turn_quads_outward(data);
    return data;
}

}  // namespace pavior
