#pragma once
/// \file
/// A sheet that repairs something, and how it is cut into the mesh.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cut_tets.hpp>
#include <pavior/marking/marking.hpp>
#include <pavior/marking/patch_surface.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace pavior {

/// Where an extra sheet lies and where it starts.
struct RepairSheet {
    SheetKind kind = SheetKind::axis;
    PatchSurface surface;
    /// It starts where it meets these edges (ascending pairs) ...
    std::vector<std::array<Index, 2>> edges;
    /// ... or, if there are none, at this node, in these tetrahedra.
    Index node = no_index;
    std::vector<Index> tets;
    /// Edges that it contains, whatever its surface says (ascending pairs).
    std::vector<std::array<Index, 2>> contained;
};

/// Cuts several repair sheets, one after the other, with sheet ids from \p first_id on. Edges and tetrahedra of the
/// sheets are those of the mesh before; sheets that start at a node must come alone. \return new layers of each sheet
PAVIOR_INLINE std::vector<std::size_t> cut_repairs(CutMesh& cut, const std::vector<RepairSheet>& repairs,
                                                   Propagation propagation, double tolerance, Index first_id);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/repair_sheet-inl.hpp>
#endif
