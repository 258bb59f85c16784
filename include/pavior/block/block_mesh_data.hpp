#pragma once
/// \file
/// Blocks, or the hexahedra inside them, as a mesh with groups.

#include <pavior/block/block_solid.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <string>

namespace pavior {

/// The fine mesh of \p solid where there is one, else its blocks. Hexahedra in groups by block, named "block 1" ..., or
/// by the cell of the solid that a block lies in, "cell 1" ...; boundary quads by the tag of the triangle of \p surface
/// that they lie on, where every patch of the reference mesh has tags from 1 on, named as the surface names the tag or
/// \p face and the tag, else by patch, "patch 1" ... Patches with several tags: the tag of the nearest triangle. Quads
/// look outward. O(n log n).
[[nodiscard]] PAVIOR_INLINE HexMeshData block_mesh_data(const SolidBlocks& solid, const TaggedSurface& surface,
                                                        const std::string& face = "tag ");

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/block_mesh_data-inl.hpp>
#endif
