#include "blocked.hpp"
#include "grouped.hpp"
#include "mesh_methods.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace pavior::cli {

namespace {

/// Whether all faces are plane and two of them meet at an angle that the default limits would call smooth.
bool has_shallow_crease(const GmshBrep& model, SolidId solid) {
    std::map<EdgeId, Vec3> normals;
    bool crease = false;
    for (const OrientedFace& f : model.solid_faces(solid)) {
        const std::optional<Plane> plane = plane_of(model, f.face);
        if (!plane) {
            return false;
        }
        const Vec3 normal = f.outward ? plane->normal : Vec3(-plane->normal);
        for (const EdgeLoop& loop : model.face_loops(f.face)) {
            for (const OrientedEdge& use : loop) {
                const auto [other, first] = normals.emplace(use.edge, normal);
                const double cosine = normal.dot(other->second);
                crease = crease || (!first && cosine > std::sqrt(0.5) && cosine < 1 - 1e-6);
            }
        }
    }
    return crease;
}

}  // namespace

void try_block(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    if (solids.size() != 1) {
        throw UnmeshableError(ErrorCode::invalid_dual,
                              "blocks are made of one solid, these are " + std::to_string(solids.size()));
    }
    BlockCommand own;
    own.input = command.input;
    own.size = mesh_size(model, command);
    own.threads = command.threads;
    for (const OrientedFace& f : model.solid_faces(solids[0])) {
        own.faces.push_back(model.tag(2, f.face.index()));
    }
    if (has_shallow_crease(model, solids[0])) {
        own.feature_angles = {179.9, 180.1, 315};
        result.notes.emplace_back("edges of less than 45 degrees are features, too, since all faces are plane");
    }
    const BlockInput input = read_block_input(own, {});
    const SolidBlocks blocks = make_blocks(own, input.reference, {});
    result.details = cli::to_json(input, blocks);
    if (!blocks.report.dual.valid()) {
        const auto& violations = blocks.report.dual.violations;
        std::ostringstream text;
        text << "the layers make no blocks, " << violations.size() << " conditions are violated";
        if (!violations.empty()) {
            text << ", the first: " << describe(violations.front());
        }
        throw UnmeshableError(ErrorCode::invalid_dual, text.str());
    }
    result.notes.push_back(std::to_string(blocks.report.blocks.blocks) + " blocks");
    result.data = block_data(input, blocks);
    result.data.hex_groups.assign(result.data.mesh.hexes.size(), model.tag(3, solids[0].index()));
    result.data.groups = entity_groups(model, solids);
}

}  // namespace pavior::cli
