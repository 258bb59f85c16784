#pragma once

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/io/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior::cli {

/// All solids of a model.
[[nodiscard]] inline std::vector<SolidId> all_solids(const GmshBrep& model) {
    std::vector<SolidId> solids;
    for (std::size_t s = 0; s < model.solid_count(); ++s) {
        solids.push_back(SolidId{static_cast<std::int32_t>(s)});
    }
    return solids;
}

/// Names of \p solids and of their faces; numbers are the tags of the CAD file.
[[nodiscard]] inline std::vector<MeshGroup> entity_groups(const GmshBrep& model, std::span<const SolidId> solids) {
    const auto name = [](const std::string& label, const char* kind, int tag) {
        return label.empty() ? kind + std::to_string(tag) : label;
    };
    std::vector<MeshGroup> groups;
    std::set<std::size_t> faces;
    for (const SolidId solid : solids) {
        const int tag = model.tag(3, solid.index());
        groups.push_back({3, tag, name(model.solid_name(solid), "solid_", tag)});
        for (const OrientedFace& face : model.solid_faces(solid)) {
            faces.insert(face.face.index());
        }
    }
    for (const std::size_t f : faces) {
        const int tag = model.tag(2, f);
        groups.push_back({2, tag, name(model.face_name(FaceId{static_cast<std::int32_t>(f)}), "face_", tag)});
    }
    return groups;
}

/// Hexahedra in groups by solid, quads in groups by face. \p Result has mesh, hex_solid, quads and quad_face.
template <class Result>
[[nodiscard]] HexMeshData grouped(const GmshBrep& model, std::span<const SolidId> solids, Result& result) {
    HexMeshData data;
    data.mesh = std::move(result.mesh);
    data.quads = std::move(result.quads);
    for (const SolidId solid : result.hex_solid) {
        data.hex_groups.push_back(model.tag(3, solid.index()));
    }
    for (const FaceId face : result.quad_face) {
        data.quad_groups.push_back(model.tag(2, face.index()));
    }
    data.groups = entity_groups(model, solids);
    return data;
}

}  // namespace pavior::cli
