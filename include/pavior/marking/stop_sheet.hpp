#pragma once
/// \file
/// Sheets that end at chains that exist already, where that does no harm.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cut.hpp>
#include <pavior/marking/marking.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace pavior {

/// Edges of class stack, ascending pairs, sorted: where a sheet stops in Propagation::stop. O(n log n). \throws Stopped
[[nodiscard]] PAVIOR_INLINE std::vector<std::array<Index, 2>> stack_edges(const ReferenceMesh& mesh,
                                                                          const Execution& execution = sequential);

/// Cuts as cut_sheet() does and, with Propagation::stop, ends the sheet at the stack edges that \p cut has, unless that
/// would leave more violations than the whole sheet. \return number of new layers. O(n), and with stop as much as
/// three checks of the cells of the mesh.
PAVIOR_INLINE std::size_t cut_sheet(CutMesh& cut, SheetCut& sheet, Index id, Propagation propagation);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/stop_sheet-inl.hpp>
#endif
