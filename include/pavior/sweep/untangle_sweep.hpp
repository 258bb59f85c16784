#pragma once
/// \file
/// Repairs the hexahedra of a sweep that are inverted.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/smooth/report.hpp>
#include <pavior/sweep/sweep_mesh.hpp>

namespace pavior {

/// Untangles the hexahedra of a sweep with the nodes of its boundary (caps and loops) fixed; each is to take the shape
/// that it has in the straight sweep of the source cap. A sweep without inverted hexahedra is only looked at: O(n)
/// time, no memory. Otherwise as untangle_hexes().
/// \param loops  node ids of the source cap on its boundary
PAVIOR_INLINE SmoothReport untangle_sweep(SweepMesh& swept, const Loops& loops, const Execution& execution = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/untangle_sweep-inl.hpp>
#endif
