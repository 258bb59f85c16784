#include "blocked.hpp"

#include <pavior/block/detail/nearest_weights.hpp>
#include <pavior/block/patch_map.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace pavior::cli {

namespace {

/// Tags of the geometry that each patch of the reference mesh carries.
std::map<std::int32_t, std::set<std::int32_t>> tags_of_patches(const ReferenceMesh& reference) {
    std::map<std::int32_t, std::set<std::int32_t>> tags;
    for (const TagOf& entry : reference.patch_tags) {
        tags[entry.id].insert(entry.tag);
    }
    return tags;
}

/// The tag of the triangle nearest to \p x among those with one of \p tags.
std::int32_t nearest_tag(const TaggedSurface& surface, const std::set<std::int32_t>& tags, const Vec3& x) {
    double best = std::numeric_limits<double>::infinity();
    std::int32_t tag = *tags.begin();
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        if (tags.count(surface.face_tags[t]) == 0) {
            continue;
        }
        const TriCorners& c = surface.mesh.triangles[t];
        const auto& nodes = surface.mesh.nodes;
        const Eigen::Vector3d w = detail::nearest_weights(x, nodes[c[0]], nodes[c[1]], nodes[c[2]]);
        const double d = (w[0] * nodes[c[0]] + w[1] * nodes[c[1]] + w[2] * nodes[c[2]] - x).squaredNorm();
        if (d < best) {
            best = d;
            tag = surface.face_tags[t];
        }
    }
    return tag;
}

Vec3 middle_of(const HexMesh& mesh, const QuadCorners& c) {
    return (mesh.nodes[c[0]] + mesh.nodes[c[1]] + mesh.nodes[c[2]] + mesh.nodes[c[3]]) / 4.0;
}

/// Groups of the quads: faces of the geometry where all have a tag, patches of the reference mesh otherwise.
void group_quads(const BlockInput& input, const SolidBlocks& solid, const std::vector<std::int32_t>& patches,
                 HexMeshData& data) {
    std::vector<Vec3> middles;
    for (const QuadCorners& c : data.quads) {
        middles.push_back(middle_of(data.mesh, c));
    }
    data.quad_groups = quad_tags(input, solid.reference, patches, middles);
    const bool tagged = !data.quad_groups.empty();
    if (!tagged) {
        for (const std::int32_t patch : patches) {
            data.quad_groups.push_back(patch + 1);
        }
    }
    const std::string name = input.cad && tagged ? "face " : tagged ? "tag " : "patch ";
    for (const int group : std::set<int>(data.quad_groups.begin(), data.quad_groups.end())) {
        data.groups.push_back({2, group, name + std::to_string(group)});
    }
}

}  // namespace

std::vector<std::int32_t> quad_tags(const BlockInput& input, const ReferenceMesh& reference,
                                    const std::vector<std::int32_t>& patches, const std::vector<Vec3>& middles) {
    const auto tags = tags_of_patches(reference);
    std::vector<std::int32_t> result;
    for (std::size_t q = 0; q < patches.size(); ++q) {
        const auto at = tags.find(patches[q]);
        if (at == tags.end() || *at->second.begin() < 1) {
            return {};  // group numbers start at 1
        }
        const bool one = at->second.size() == 1 || input.surface.face_tags.empty();
        result.push_back(one ? *at->second.begin() : nearest_tag(input.surface, at->second, middles[q]));
    }
    return result;
}

HexMeshData block_data(const BlockInput& input, const SolidBlocks& solid) {
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
    group_quads(input, solid, patches, data);
    return data;
}

}  // namespace pavior::cli
