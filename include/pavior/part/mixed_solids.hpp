#pragma once
/// \file
/// Touching solids, each meshed by the method that suits it, conforming.

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/many_to_many/local_sizes.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_options.hpp>

#include <functional>
#include <map>
#include <span>

namespace pavior {

struct MixedOptions {
    double size = 0;        ///< wished length of mesh edges; must be given
    int min_loop = 4;       ///< intervals of a loop of a cap of a one-to-one sweep, at least
    double max_angle = 30;  ///< an edge turns by at most this from one interval to the next, degrees
    LocalSizes sizes;
    Execution execution = sequential;
};

/// Hexahedra of a model with their entities: groups of many-to-many sweeps, swept solids, submapped solids.
struct MixedSolids : SolidsMesh {
    std::map<SolidId, PartMethod> methods;
};

/// Meshes \p solids, which touch, each by its own method: those that are neither submappable nor one-to-one sweeps are
/// swept many-to-many first, those that touch together in one direction; the others are submapped or swept one-to-one,
/// with shared faces as they find them (choose_methods()), in one interval assignment.
/// The result is not verified; use verify_hexes(). Deterministic if the callables are, but for out_of_time().
/// \throws UnmeshableError naming faces if a solid admits no method, or none that fits its neighbours: many-to-many
/// sweeps of different directions that touch, faces with unstructured quads that no neighbour can sweep from;
/// InputError bad_option (size)
[[nodiscard]] PAVIOR_INLINE MixedSolids mixed_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                     const MixedOptions& options, const Kernels& kernels,
                                                     const std::function<bool()>& out_of_time);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/mixed_solids-inl.hpp>
#endif
