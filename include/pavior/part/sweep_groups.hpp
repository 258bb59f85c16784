#pragma once
/// \file
/// Solids that touch and are many-to-many sweeps, each in its own direction: which of them are swept together, and in
/// which order.

#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// A way to part solids into groups of one direction each.
struct SweepGroups {
    std::vector<std::vector<SolidId>> groups;  ///< in the order in which they are best meshed
    double cost = 0;                           ///< the more and the harder faces lie between groups, the more
};

/// Ways to part \p solids into groups that touch within and in which each solid by itself is an extrusion in one
/// direction (recognise_extrusions()), the least cost first, at most \p most. Between two groups a face that is a side
/// of both costs least, then one that is a cap of one or both, most a cap with holes that is a side of the other; the
/// group whose side it is comes first, so that the other finds the mesh of its cap. Solids without a direction of their
/// own, swept round axes or along paths, make groups by touching. Deterministic. O(directions solids^2) for each way.
[[nodiscard]] PAVIOR_INLINE std::vector<SweepGroups> sweep_groups(const AnyModel& b, std::span<const SolidId> solids,
                                                                  std::size_t most = 6);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/sweep_groups-inl.hpp>
#endif
