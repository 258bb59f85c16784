#pragma once
/// \file
/// Which method meshes which one of solids that touch.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/submap/submap_classes.hpp>

#include <span>
#include <vector>

namespace pavior {

/// What a solid admits by itself.
struct SolidWays {
    SolidId solid;
    bool submap = false;
    std::vector<SweepTopology> sweeps;  ///< best first

    /// Neither submapped nor swept one-to-one.
    [[nodiscard]] bool only_multi_sweep() const { return !submap && sweeps.empty(); }
};

/// Looks at each of \p solids alone, submapped as \p submap says. Deterministic if the solver is.
[[nodiscard]] PAVIOR_INLINE std::vector<SolidWays> solid_ways(const AnyModel& b, std::span<const SolidId> solids,
                                                              const IntegerSolver& solver,
                                                              const SubmapOptions& submap = {});

/// The methods chosen.
struct MethodChoice {
    std::vector<SweepTopology> sweeps;
    std::vector<SolidId> submaps;
};

/// Chooses a method for each of \p ways, none of which may be only_multi_sweep(): solids at faces of \p given, and at
/// faces that inherit such a mesh through a sweep, are swept so that these are caps, or linking sides with grids on
/// them, or submapped where no sweep fits. The others are submapped where they can be (\p prefer_submap) or where they
/// cannot be swept, else swept.
/// Grids of \p given are put in order (structure_side()). O(solids squared) in the worst case.
/// \throws UnmeshableError not_sweepable naming the faces that a solid cannot be fitted to
[[nodiscard]] PAVIOR_INLINE MethodChoice choose_methods(const AnyModel& b, std::span<const SolidWays> ways,
                                                        BoundaryMesh& given, bool prefer_submap);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/solid_methods-inl.hpp>
#endif
