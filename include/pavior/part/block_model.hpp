#pragma once
/// \file
/// A solid of a model by blocks.

#include <pavior/block/block_solid.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>

namespace pavior {

/// Blocks of a solid and the hexahedra inside them.
struct BlockedModel {
    BlockReference reference;
    SolidBlocks blocks;
    bool shallow_creases = false;  ///< edges of less than 45 degrees count as features, too, since all faces are plane
};

/// Makes tetrahedra by \p reference, and blocks by block_solid(). \p options.refine says how fine.
/// \throws what \p reference and block_solid() throw
[[nodiscard]] PAVIOR_INLINE BlockedModel block_model(const AnyModel& b, SolidId solid, const BlockOptions& options,
                                                     const ReferenceMesher& reference);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/block_model-inl.hpp>
#endif
