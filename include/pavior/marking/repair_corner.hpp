#pragma once
/// \file
/// Repair of corners that do not have three chains: a sheet through two of more, one that crosses between fewer.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/repair_sheet.hpp>

#include <optional>

namespace pavior {

/// The sheet that splits the worst corner (most chains, then smallest vertex) among those with more than three; none if
/// no pair of chains of any spans a plane that leaves the others on its two sides. Planes that pass through many
/// hexahedron vertices and few near misses win, then those far from the other chains, then those near to many vertices.
/// If there are only corners with one or two chains, a plane across the one, or halfway between the two, at
/// the first of them.
/// \p tolerance and \p size are lengths: of what counts as on the plane, and of the solid.
[[nodiscard]] PAVIOR_INLINE std::optional<RepairSheet> repair_corner(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                                     double tolerance, double size);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/repair_corner-inl.hpp>
#endif
