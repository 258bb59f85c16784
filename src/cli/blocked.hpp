#pragma once

#include "commands.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace pavior::cli {

/// What a block command works on.
struct BlockInput {
    ReferenceMesh reference;
    TaggedSurface surface;  ///< the boundary with its tags
    bool cad = false;       ///< the tags are those of the faces of a CAD model
    double read_seconds = 0.0;
    double tetra_seconds = 0.0;
};

/// Reads surface, CAD model or tetrahedra and makes the reference mesh.
[[nodiscard]] BlockInput read_block_input(const BlockCommand& command, const Progress& progress);

/// block_solid() with the options of the command.
[[nodiscard]] SolidBlocks make_blocks(const BlockCommand& command, const ReferenceMesh& reference,
                                      const Progress& progress);

/// The tag of the geometry of each boundary quad of patch \p patches[q] with its middle at \p middles[q]; empty if the
/// geometry has no tags.
[[nodiscard]] std::vector<std::int32_t> quad_tags(const BlockInput& input, const ReferenceMesh& reference,
                                                  const std::vector<std::int32_t>& patches,
                                                  const std::vector<Vec3>& middles);

/// Blocks, or their refinement where there is one, with groups: a cell of the blocks or a block each.
[[nodiscard]] HexMeshData block_data(const BlockInput& input, const SolidBlocks& solid);

/// Counts, sheets, violations and times.
[[nodiscard]] nlohmann::json to_json(const BlockInput& input, const SolidBlocks& solid);

}  // namespace pavior::cli
