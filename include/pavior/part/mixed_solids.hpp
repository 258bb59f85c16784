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
#include <pavior/submap/submap_classes.hpp>

#include <functional>
#include <map>
#include <span>

namespace pavior {

struct MixedOptions {
    double size = 0;        ///< wished length of mesh edges; must be given
    int min_loop = 4;       ///< intervals of a loop of a cap of a one-to-one sweep, at least
    double max_angle = 30;  ///< an edge turns by at most this from one interval to the next, degrees
    LocalSizes sizes;
    SubmapOptions submap = {};
    Execution execution = sequential;
};

/// Hexahedra of a model with their entities: groups of many-to-many sweeps, swept solids, submapped solids.
struct MixedSolids : SolidsMesh {
    std::map<SolidId, PartMethod> methods;
};

/// Meshes \p solids, which touch, each by its own method: those that are neither submappable nor one-to-one sweeps are
/// swept many-to-many first; the others are submapped or swept one-to-one, with shared faces as they find them
/// (choose_methods()), in one interval assignment.
///
/// Solids to be swept many-to-many that touch are swept together where they have one direction, else in groups of one
/// direction each (sweep_groups()), one after the other: the later ones keep the nodes of the earlier ones, quad for
/// quad. A face between them may be a side of both (a grid in both), a cap that lies on a side (it takes that grid),
/// or a cap of both. A group that cannot take what the earlier ones give comes first then; where no order helps, each
/// takes its levels from the neighbours first. They are refused where that fails, too: a cap whose quads are no grid
/// beside a side, edges of other levels that meet a given side or cap between its nodes.
///
/// Where solids are refused so, or come out inverted, they are seen in more ways: first sides of one-to-one sweeps may
/// run round corners of 270 degrees (StackingOptions::flat_notches), then faces that go on in each other across an edge
/// of no other face count as one (JoinedFaces); quads there may lie across that edge, and belong to the face on which
/// their middle lies.
///
/// The result is not verified; use verify_hexes(). Deterministic if the callables are, but for out_of_time().
/// \throws UnmeshableError naming solids and faces if a solid admits no method, or none that fits its neighbours:
/// groups as above, faces with unstructured quads that no neighbour can sweep from, demands on numbers of intervals
/// that contradict each other; InputError bad_option (size)
[[nodiscard]] PAVIOR_INLINE MixedSolids mixed_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                     const MixedOptions& options, const Kernels& kernels,
                                                     const std::function<bool()>& out_of_time);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/mixed_solids-inl.hpp>
#endif
