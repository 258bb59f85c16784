#include "blocked.hpp"
#include "grouped.hpp"
#include "mesh_methods.hpp"

#include <sstream>

namespace pavior::cli {

void try_block(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    if (model.solid_count() != 1) {
        throw UnmeshableError(ErrorCode::invalid_dual,
                              "blocks are made of one solid, the file has " + std::to_string(model.solid_count()));
    }
    BlockCommand own;
    own.input = command.input;
    own.size = mesh_size(model, command);
    own.threads = command.threads;
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
    result.data.hex_groups.assign(result.data.mesh.hexes.size(), model.tag(3, 0));
    result.data.groups = entity_groups(model, solids);
}

}  // namespace pavior::cli
