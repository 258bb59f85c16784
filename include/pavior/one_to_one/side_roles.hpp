#pragma once
/// \file
/// From a role per half-edge (bottom, right, top, left) to a sweep: the checks that make roles a sweep topology.

#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace pavior {

namespace detail {

/// Quarters by which the boundary of a linking side turns between edges of these roles: 0, 1 (a corner of 90 degrees),
/// -1 (of 270 degrees), or 2 (none that a side may have).
[[nodiscard]] constexpr int quarter_turn(SideRole before, SideRole after) {
    const int turn = (static_cast<int>(after) - static_cast<int>(before) + 4) % 4;
    return turn == 3 ? -1 : turn;
}

/// A cap loop (half-edges in the sweep's sense) as oriented edges, beginning with \p begin if that edge is part of it.
[[nodiscard]] PAVIOR_INLINE EdgeLoop cap_edges(const SolidBoundary& solid, const std::vector<std::size_t>& half_edges,
                                               bool source, const OrientedEdge& begin);

/// Turns roles into a sweep between the faces at positions \p source and \p target; nothing if they do not make one.
/// `shape` is left to the caller.
[[nodiscard]] PAVIOR_INLINE std::optional<SweepTopology> sweep_from_roles(const SolidBoundary& solid,
                                                                          std::size_t source, std::size_t target,
                                                                          const std::vector<SideRole>& roles);

/// The sweep between two faces (positions) if all side faces reach from one to the other, or nothing.
[[nodiscard]] PAVIOR_INLINE std::optional<SweepTopology> find_direct_sweep(const SolidBoundary& solid,
                                                                           std::size_t source, std::size_t target);

/// Roles for side faces that all reach from source to target: edges on the source are bottom, edges on the target top,
/// the chains between them right and left. Faces that do not fit keep `none` somewhere.
[[nodiscard]] PAVIOR_INLINE std::vector<SideRole> direct_roles(const SolidBoundary& solid, std::size_t source,
                                                               std::size_t target);

/// The logical sides of a face with one loop; nothing if its roles do not turn once round, by quarters at corners.
[[nodiscard]] PAVIOR_INLINE std::optional<LinkingSide> side_from_roles(const SolidBoundary& solid, std::size_t face,
                                                                       const std::vector<SideRole>& roles);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/side_roles-inl.hpp>
#endif
