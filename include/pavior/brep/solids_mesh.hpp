#pragma once
/// \file
/// Hexahedra of the solids of a CAD model, with quads on its faces.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <vector>

namespace pavior {

/// Hexahedra with their solids, and the mesh of the faces. What methods make of a model derives from it.
struct SolidsMesh {
    HexMesh mesh;
    std::vector<SolidId> hex_solid;  ///< one a hexahedron
    std::vector<QuadCorners> quads;  ///< mesh of the faces (ids of nodes of `mesh`), about the face's own normal
    std::vector<FaceId> quad_face;   ///< one a quad
};

/// Appends \p other to \p mesh, all ids of nodes moved behind those that are there. Nodes are not merged. O(other).
PAVIOR_INLINE void append_solids(const SolidsMesh& other, SolidsMesh& mesh);

/// Appends \p other, whose first nodes are those of \p mesh, to it: nodes keep the ids that they have in \p other, and
/// places too. O(other).
PAVIOR_INLINE void extend_solids(const SolidsMesh& other, SolidsMesh& mesh);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/solids_mesh-inl.hpp>
#endif
