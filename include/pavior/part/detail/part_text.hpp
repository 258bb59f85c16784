#pragma once
/// \file
/// What mesh_part() says of its tries.

#include <pavior/block/block_solid.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/decompose/cut_search.hpp>
#include <pavior/decompose/solid_cut.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/submap/submap_model.hpp>

#include <string>
#include <vector>

namespace pavior {

/// "along (0, 0, 1)", "round the axis through (1, 2, 3) along (0, 0, 1)" or "parallel to edges 7, 8".
/// \param edges tags of the edges of path.ribs
[[nodiscard]] PAVIOR_INLINE std::string text_of(const SweepPath& path, const std::vector<int>& edges);

namespace detail {

[[nodiscard]] PAVIOR_INLINE std::string note_of(const SubmapSolidReport& solid);
[[nodiscard]] PAVIOR_INLINE std::string note_of(const MultiSweepAttempt& attempt, const std::vector<int>& edges);

/// "plane through (1, 2, 3) normal to (0, 0, 1)" ...
[[nodiscard]] PAVIOR_INLINE std::string text_of(const CutSurface& surface);
/// "foot of a blend: cylinder of radius 2 round ..."
[[nodiscard]] PAVIOR_INLINE std::string text_of(const SolidCut& cut);
/// Why no cuts were found.
[[nodiscard]] PAVIOR_INLINE UnmeshableError not_decomposed(const CutSearch& search);

/// \throws UnmeshableError invalid_dual where there are no blocks, with the first reason
PAVIOR_INLINE void require_blocks(const SolidBlocks& blocks);

/// Sets outcome, reason and faces.
PAVIOR_INLINE void refuse(MethodTry& result, const Error& error);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/detail/part_text-inl.hpp>
#endif
