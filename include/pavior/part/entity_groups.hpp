#pragma once
/// \file
/// Meshes of solids as groups: hexahedra by solid, quads by face, with the numbers and names of the CAD file.

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/part/any_model.hpp>

#include <span>
#include <vector>

namespace pavior {

/// Names of \p solids and of their faces; numbers are the user's tags, pieces of one entity
/// of the file one group. An entity without a name is "solid_3", "face_7".
[[nodiscard]] PAVIOR_INLINE std::vector<MeshGroup> entity_groups(const AnyModel& b, std::span<const SolidId> solids);

/// \p mesh with its groups, its quads turned outward (turn_quads_outward()).
[[nodiscard]] PAVIOR_INLINE HexMeshData grouped(const AnyModel& b, std::span<const SolidId> solids, SolidsMesh mesh);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/entity_groups-inl.hpp>
#endif
