#pragma once
/// \file
/// Whether a mesh is a mesh of its solids.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/part_mesh.hpp>

#include <optional>
#include <span>
#include <utility>

namespace pavior {

/// Sets outcome, reason, hexahedra and min_jacobian of \p result, whose data is a mesh of \p solids: valid if it
/// conforms, no hexahedron is inverted or flat, and its volume is that of the solids as far as the model knows theirs
/// (up to what lies between quads and curved faces). \return the check, and the volume of the solids.
PAVIOR_INLINE std::pair<MeshCheck, std::optional<double>> judge_mesh(const AnyModel& b, std::span<const SolidId> solids,
                                                                     Execution execution, MethodTry& result);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/judge_mesh-inl.hpp>
#endif
