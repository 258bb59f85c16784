#pragma once
/// \file
/// Meshes touching solids, some swept, some submapped, beside others that are meshed already.

#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/sweep_model.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/submap/submap_model.hpp>

#include <map>
#include <span>
#include <vector>

namespace pavior {

struct MixedModelOptions {
    ModelSweepOptions sweep;
    SolidSubmapOptions submap;
};

/// Nodes: those given first, with their ids, then new ones as in ModelMesh. Hexahedra: swept solids, then submapped
/// ones. Quads of faces that were given are left out.
struct MixedMesh : ModelMesh {
    std::vector<SubmapSolidReport> submapped;  ///< in the order of SubmapModel::solids
};

/// The numbers of intervals of the edges of \p given, as IntervalOptions::edge_intervals.
[[nodiscard]] PAVIOR_INLINE std::map<int, int> given_intervals(const AnyModel& b, const BoundaryMesh& given);

/// Meshes the solids of \p sweeps and \p submaps with the numbers of assign_submap_intervals() for both, each shared
/// face once: submapped faces first, then linking sides, then caps in an order in which each sweep finds the mesh of a
/// neighbour at its source. \p given (neighbour_boundary(), or empty) holds what neighbours that are done have made of
/// the faces and edges that they share; its edges must have the numbers of \p intervals (given_intervals()).
/// The result is not verified; use verify_hexes(). Deterministic if the model and the mesher are.
/// \throws UnmeshableError not_sweepable naming faces on which neighbours need different meshes, not_submappable naming
/// a face of a submapped solid whose given mesh is not structured; what sweep_model() and submap_model() throw
[[nodiscard]] PAVIOR_INLINE MixedMesh mixed_model(const AnyModel& b, std::span<const SweepTopology> sweeps,
                                                  const SubmapModel& submaps, const SubmapIntervals& intervals,
                                                  const CapMesher& mesher, BoundaryMesh given = {},
                                                  const MixedModelOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/mixed_model-inl.hpp>
#endif
