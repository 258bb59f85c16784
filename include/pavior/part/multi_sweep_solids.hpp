#pragma once
/// \file
/// Many-to-many sweeps of solids in one call.

#include <pavior/core/compiled.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>

#include <functional>
#include <span>

namespace pavior {

/// best_multi_sweep() of any model with \p kernels, good enough at a least scaled Jacobian of 0.3. \p given: the mesh
/// of neighbours that is kept, null for none.
[[nodiscard]] PAVIOR_INLINE BestMultiSweep multi_sweep_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                              const MultiSweepOptions& options, const Kernels& kernels,
                                                              const std::function<bool()>& out_of_time,
                                                              const LocalSizes& sizes = {},
                                                              const BoundaryMesh* given = nullptr);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/multi_sweep_solids-inl.hpp>
#endif
