#pragma once
/// \file
/// Rows and columns in the mesh of a linking side that was made elsewhere.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>
#include <pavior/sweep/unwrap.hpp>

namespace pavior {

/// Reorders the mesh of \p side's face as mesh_linking_side() would have made it, rows along the bottom, if its quads
/// are a grid between the nodes of the side's four chains; for sides that are rectangles. \p periods of the face.
/// O(n log n).
/// \return false, with nothing changed, if they are no such grid
PAVIOR_INLINE bool structure_side(BoundaryMesh& mesh, const LinkingSide& side, const Periods& periods);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/structure_side-inl.hpp>
#endif
