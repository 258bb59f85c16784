#pragma once
/// \file
/// Several meshes in the arrays of one.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <span>
#include <vector>

namespace pavior {

/// Appends the nodes and hexahedra of \p other to \p mesh, and the quads on it (ids of its own nodes) to \p quads, all
/// ids moved behind the nodes that are there. Nodes are not merged. O(other).
PAVIOR_INLINE void append_mesh(const HexMesh& other, std::span<const QuadCorners> other_quads, HexMesh& mesh,
                               std::vector<QuadCorners>& quads);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/append_mesh-inl.hpp>
#endif
