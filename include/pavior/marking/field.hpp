#pragma once
/// \file
/// The field whose zero set is the sheet of a group of fronts, with the sides of the nodes that are decided by the
/// boundary.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/faces.hpp>
#include <pavior/marking/groups.hpp>

#include <span>

namespace pavior {

/// The field of \p group on the nodes of \p mesh, which may have been cut since the fronts were found; \p nodes are
/// those at that time (the first nodes of the mesh). Values within \p tolerance, a length, snap to zero.
/// O(n) for one surface, O(n k) for a blend of patches with k triangles.
[[nodiscard]] PAVIOR_INLINE SheetCut sheet_field(const ReferenceMesh& mesh, const SheetGroup& group,
                                                 std::span<const Front> fronts, const FrontBoundary& boundary,
                                                 double tolerance);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/field-inl.hpp>
#endif
