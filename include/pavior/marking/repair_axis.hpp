#pragma once
/// \file
/// Repair of what is round: planes through the axes of closed chains and of patches with too few corners, or through
/// a centre where there is no axis.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/repair_sheet.hpp>

#include <vector>

namespace pavior {

/// The sheets through everything round that violates the conditions, all of one axis sharing theirs: two
/// perpendicular planes through each axis, turned to the planar patches of the solid if there are any; three through
/// each centre; the plane and the cylinder through the circle of centres of a torus; one halfway between the corners
/// of a patch with two. Empty if nothing round is in the way.
[[nodiscard]] PAVIOR_INLINE std::vector<RepairSheet> repair_axes(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                                 double size);

namespace detail {

/// Planes that coincide within \p tolerance, a length, where they start become one sheet, the first.
PAVIOR_INLINE void merge_planes(std::vector<RepairSheet>& sheets, double tolerance);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/repair_axis-inl.hpp>
#endif
