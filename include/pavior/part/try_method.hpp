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

/// What \p method makes of \p solids, which touch each other; errors of any kind end in the outcome, but for Stopped.
/// Local sizes by name must have been resolved. \p out_of_time may be asked now and then.
[[nodiscard]] PAVIOR_INLINE MethodTry try_method(PartMethod method, const AnyModel& model,
                                                 std::span<const SolidId> solids, const PartOptions& options,
                                                 const Kernels& kernels, const std::function<bool()>& out_of_time);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/try_method-inl.hpp>
#endif
