#pragma once
/// \file
/// One-to-one sweeps of solids in one call: recognition, numbers of intervals, mesh.

#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/sweep_model.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior {

struct SweepSolidsOptions {
    IntervalOptions intervals;
    ModelSweepOptions sweep;
    std::optional<int> source, target;  ///< tags of faces that are to be caps where they bound a solid
};

/// Hexahedra, and how they came about.
struct SweptSolids {
    ModelMesh mesh;
    IntervalAssignment intervals;
    std::vector<std::string> warnings;
};

/// Sweeps \p solids of \p b one-to-one, one conforming mesh for all; each along the best of its sweeps that has the
/// caps asked for. Where a cap between very few nodes admits no quads that are not folded, finer sizes are tried, with
/// a warning. The result is not verified; use check_mesh(). Deterministic if the model and the callables are.
/// \throws UnmeshableError naming faces; InputError bad_option (size, source, target)
[[nodiscard]] PAVIOR_INLINE SweptSolids sweep_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                     const SweepSolidsOptions& options, const IntegerSolver& solver,
                                                     const CapMesher& mesher);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/sweep_solids-inl.hpp>
#endif
