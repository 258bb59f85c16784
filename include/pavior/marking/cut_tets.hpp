#pragma once
/// \file
/// Bisection of chosen edges of a reference mesh: conforming, deterministic, everything on the mesh inherited.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/dual/reference_mesh.hpp>

#include <span>
#include <vector>

namespace pavior {

/// An edge to bisect, low < high, and where: at node[low] + fraction (node[high] - node[low]), 0 < fraction < 1.
struct EdgeCut {
    Index low = 0;
    Index high = 0;
    double fraction = 0.5;
};

/// A reference mesh under the knife: its layers know their sheets.
struct CutMesh {
    ReferenceMesh mesh;
    std::vector<Index> layer_sheets;  ///< per layer
    std::vector<char> marks;          ///< per tetrahedron, inherited by its pieces; empty: none
    Execution execution = {};         ///< of the work on it: whatever cuts it throws Stopped when asked to
};

/// Bisects the edges of \p cuts, which must be sorted by (low, high) and different: cut k makes the node that had the
/// id node count + k. Each tetrahedron, patch face, curve edge and layer with cut edges is replaced by its pieces;
/// they keep its orientation, tag, curve, sheet and mark. Tetrahedra with several cuts bisect the first one first, so
/// that the result conforms. O(n).
PAVIOR_INLINE void bisect_edges(CutMesh& cut, std::span<const EdgeCut> cuts);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/cut_tets-inl.hpp>
#endif
