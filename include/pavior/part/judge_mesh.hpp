#pragma once
/// \file
/// Whether a mesh is a mesh of its solids.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/part_mesh.hpp>

#include <functional>
#include <span>

namespace pavior {

struct JudgeOptions {
    Execution execution = sequential;
    double size = 0;       ///< wished length of mesh edges, in which distances are told; 0: none
    double tolerance = 0;  ///< to which the model is exact (CadOptions::imprint_tolerance), a length
    bool alone = true;     ///< the solids are all of the model: warnings need not name them
    /// Asked now and then; once true, what is left of the comparison with the model is not done. Empty: never.
    std::function<bool()> out_of_time = {};
};

/// Sets outcome, reason, hexahedra, min_jacobian and deviation of \p result, whose data is a mesh of \p solids: valid if
/// it conforms, no hexahedron is inverted or flat, and its volume is that of the solids as far as the model knows theirs
/// (up to what lies between quads and curved faces). Adds warnings where it differs much from the solids. Where the
/// time was over before it was compared with the model, a mesh that conforms is valid, with a warning that says so.
/// A deviation whose distance is known already is kept.
PAVIOR_INLINE MeshCheck judge_mesh(const AnyModel& b, std::span<const SolidId> solids, const JudgeOptions& options,
                                   MethodTry& result);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/judge_mesh-inl.hpp>
#endif
