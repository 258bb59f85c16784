#pragma once
/// \file
/// One method on some solids of a model, from recognition to judgement.

#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_mesh.hpp>

#include <functional>
#include <span>

namespace pavior {

/// What a try asks and tells about its time.
struct TryTimes {
    std::function<bool()> out_of_time;            ///< asked by the methods now and then; must be given
    std::function<bool()> no_time_to_check = {};  ///< asked while the mesh is compared with the model; empty: never
    std::function<void()> made = {};              ///< called once there is a mesh, before it is checked
    double seconds = 0;                           ///< limit of the try, for those that plan ahead; 0: none
};

/// What \p method makes of \p solids, which touch each other; errors of any kind end in the outcome, but for Stopped.
/// Local sizes by name must have been resolved.
[[nodiscard]] PAVIOR_INLINE MethodTry try_method(PartMethod method, const AnyModel& model,
                                                 std::span<const SolidId> solids, const PartOptions& options,
                                                 const Kernels& kernels, const TryTimes& times);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/try_method-inl.hpp>
#endif
