#pragma once

#include <pavior/part/multi_sweep_solids.hpp>

namespace pavior {

PAVIOR_INLINE BestMultiSweep multi_sweep_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                const MultiSweepOptions& options, const Kernels& kernels,
                                                const std::function<bool()>& out_of_time, const LocalSizes& sizes,
                                                const BoundaryMesh* given) {
    return best_multi_sweep(b, solids, options, kernels.imprint, kernels.solver, kernels.regions, out_of_time, 0.3,
                            sizes, given);
}

}  // namespace pavior
