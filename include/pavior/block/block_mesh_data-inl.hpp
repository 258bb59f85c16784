#pragma once

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/detail/tag_finder.hpp>
#include <pavior/mesh/outward_quads.hpp>

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace pavior {

namespace detail {

/// The tag of each quad, empty if the geometry has no tags.
[[nodiscard]] inline std::vector<std::int32_t> quad_tags(const SolidBlocks& solid, const TaggedSurface& surface,
                                                         const HexMeshData& data,
                                                         const std::vector<std::int32_t>& patches) {
    TagFinder finder(solid.reference, surface);
    std::vector<std::int32_t> result;
    for (std::size_t q = 0; q < patches.size(); ++q) {
        const QuadCorners& c = data.quads[q];
        const std::vector<Vec3>& x = data.mesh.nodes;
        const std::int32_t tag = finder.tag(patches[q], (x[c[0]] + x[c[1]] + x[c[2]] + x[c[3]]) / 4.0);
        if (tag < 1) {
            return {};  // group numbers start at 1
        }
        result.push_back(tag);
    }
    return result;
}

}  // namespace detail

PAVIOR_INLINE HexMeshData block_mesh_data(const SolidBlocks& solid, const TaggedSurface& surface,
                                          const std::string& face) {
    HexMeshData data;
    std::vector<std::int32_t> patches;  // of the reference mesh, one a quad
    if (solid.fine) {
        data.mesh = solid.fine->mesh;
        for (const BlockQuad& quad : solid.fine->boundary) {
            data.quads.push_back(quad.nodes);
            patches.push_back(quad.tag);
        }
        for (const Index block : solid.fine->hex_block) {
            data.hex_groups.push_back(static_cast<std::int32_t>(block) + 1);
        }
    } else {
        data.mesh = {solid.placement.positions, solid.blocks.hexes};
        for (const Index q : IndexRange(solid.blocks.quads.size())) {
            if (solid.blocks.boundary_quad(q)) {
                data.quads.push_back(solid.blocks.quads[q]);
                patches.push_back(solid.blocks.nodes[solid.blocks.quad_origin(q)].geometry.tag);
            }
        }
        for (const Index h : IndexRange(solid.blocks.hexes.size())) {
            const Index cell = solid.blocks.nodes[solid.blocks.hex_origin(h)].id;
            data.hex_groups.push_back(static_cast<std::int32_t>(cell) + 1);
        }
    }
    const std::string name = solid.fine ? "block " : "cell ";
    for (const int group : std::set<int>(data.hex_groups.begin(), data.hex_groups.end())) {
        data.groups.push_back({3, group, name + std::to_string(group)});
    }
    data.quad_groups = detail::quad_tags(solid, surface, data, patches);
    const bool tagged = !data.quad_groups.empty();
    if (!tagged) {
        for (const std::int32_t patch : patches) {
            data.quad_groups.push_back(patch + 1);
        }
    }
    for (const int group : std::set<int>(data.quad_groups.begin(), data.quad_groups.end())) {
        const auto own = surface.face_names.find(group);
        const bool named = tagged && own != surface.face_names.end();
        data.groups.push_back({2, group, named ? own->second : (tagged ? face : "patch ") + std::to_string(group)});
    }
    turn_quads_outward(data);
    return data;
}

}  // namespace pavior
