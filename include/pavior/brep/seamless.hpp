#pragma once
/// \file
/// Faces without their seams: where a closed surface is cut open for its parameters' sake, nothing ends.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Whether an edge bounds \p face on both sides. O(n log n) for n edges.
template <brep B>
[[nodiscard]] bool has_seam(const B& b, FaceId face) {
    std::vector<EdgeId> edges;
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            edges.push_back(use.edge);
        }
    }
    std::sort(edges.begin(), edges.end());
    return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
}

/// Loops without the edges that occur in them twice, once in each sense: at the end of an edge the boundary goes on
/// behind the seam. [rim, seam, -seam] of a dome becomes [rim], [outer, seam, inner, -seam] of a ring [outer] and
/// [inner]. Loops come in the order of their first edges. O(n log n).
[[nodiscard]] PAVIOR_INLINE std::vector<EdgeLoop> seamless_loops(std::span<const EdgeLoop> loops);

/// The boundary of a solid without the seams of the faces at the positions \p faces: their loops as of
/// seamless_loops(), angles at the ends of a seam summed up. Other faces keep their half-edges, in the same order; all
/// are renumbered. O(n).
[[nodiscard]] PAVIOR_INLINE SolidBoundary without_seams(const SolidBoundary& solid, std::span<const std::size_t> faces);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/seamless-inl.hpp>
#endif
