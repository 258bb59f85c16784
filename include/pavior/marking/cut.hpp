#pragma once
/// \file
/// Cuts a reference mesh along the zero set of a field and makes layers of those components that start somewhere.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/faces.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

/// Bisects the edges that the zero set crosses where it hangs together with a start. \return all faces on it
PAVIOR_INLINE std::vector<SheetFace> bisect_along(CutMesh& cut, SheetCut& sheet);

}  // namespace detail

/// Cuts \p cut along the zero set of \p sheet and makes layers, with the sheet id \p id, of its components that start
/// at the start edges or marks; elsewhere nothing is cut. values and fixed must cover the nodes of the mesh; start
/// edges must be edges of the mesh with both values zero. \return number of new layers. O(n) a call, and a few rounds
/// of bisections where the zero set is curved.
inline std::size_t cut_sheet(CutMesh& cut, SheetCut& sheet, Index id) {
    const std::vector<SheetFace> faces = detail::bisect_along(cut, sheet);
    return detail::add_layers(cut, detail::keep_started(cut, sheet, faces), id);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/cut-inl.hpp>
#endif
