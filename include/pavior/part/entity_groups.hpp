#pragma once
/// \file
/// Meshes of solids as groups: hexahedra by solid, quads by face, with the numbers and names of the CAD file.

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/part/model_extras.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Names of \p solids and of their faces; numbers are the user's tags. An entity without a name is "solid_3", "face_7".
template <brep B>
[[nodiscard]] std::vector<MeshGroup> entity_groups(const B& b, std::span<const SolidId> solids) {
    const auto name = [](const std::string& label, const char* kind, int tag) {
        return label.empty() ? kind + std::to_string(tag) : label;
    };
    std::vector<MeshGroup> groups;
    std::set<std::size_t> faces;
    for (const SolidId solid : solids) {
        const int tag = b.tag(3, solid.index());
        groups.push_back({3, tag, name(name_of(b, solid), "solid_", tag)});
        for (const OrientedFace& face : b.solid_faces(solid)) {
            faces.insert(face.face.index());
        }
    }
    for (const std::size_t f : faces) {
        const int tag = b.tag(2, f);
        groups.push_back({2, tag, name(name_of(b, FaceId{static_cast<std::int32_t>(f)}), "face_", tag)});
    }
    return groups;
}

/// \p mesh with its groups.
template <brep B>
[[nodiscard]] HexMeshData grouped(const B& b, std::span<const SolidId> solids, SolidsMesh mesh) {
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
    return data;
}

}  // namespace pavior
