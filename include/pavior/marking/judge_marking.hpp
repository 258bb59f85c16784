#pragma once
/// \file
/// What a marking is worth: valid or not, how many blocks, how good.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/marking.hpp>

namespace pavior {

/// Fills in what \p report says about \p mesh, whose state is \p now: validity, violations, blocks, quality, aspect,
/// layers of each sheet. O(n), and one call of options.quality if the marking is valid.
PAVIOR_INLINE void judge_marking(const ReferenceMesh& mesh, const CellSnapshot& now, const MarkingOptions& options,
                                 SheetReport& report);

/// True if \p a is the better outcome: valid before invalid, positive Jacobians before others, then the smallest
/// Jacobian up to 0.2, then fewer violations, then fewer blocks.
[[nodiscard]] PAVIOR_INLINE bool better_marking(const SheetReport& a, const SheetReport& b);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/judge_marking-inl.hpp>
#endif
