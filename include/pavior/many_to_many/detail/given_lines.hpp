#pragma once
/// \file
/// The lines of a mesh that is given on a face, as a sweep along a direction sees them.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// The line between two points of a frame runs along its third axis rather than across it.
[[nodiscard]] inline bool is_upright(const Vec3& a, const Vec3& b) {
    constexpr double lean = 0.5;  // of the height
    return (b - a).head<2>().norm() < lean * std::abs((b - a)[2]);
}

/// Every quad has two edges along the third axis that lie opposite, and two across it.
[[nodiscard]] PAVIOR_INLINE bool is_upright_grid(std::span<const Vec3> nodes, std::span<const QuadCorners> quads);

/// Edges of the quads, as positions in FaceMesh::nodes, ascending, that do not lie along edges of the face. \p along:
/// pairs of neighbouring nodes (ids) of these, the smaller first.
[[nodiscard]] PAVIOR_INLINE std::vector<std::array<Index, 2>> lines_off(const FaceMesh& mesh,
                                                                        std::vector<std::pair<Index, Index>> along);

/// The edges of the quads that \p given holds on \p face, as positions in FaceMesh::nodes, without those along edges of
/// the face, which must be given, too. O(n log n).
template <brep B>
[[nodiscard]] std::vector<std::array<Index, 2>> lines_inside(const B& b, const BoundaryMesh& given, FaceId face) {
    std::vector<std::pair<Index, Index>> along;
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            const std::vector<Index>& nodes = given.edges[use.edge.index()].nodes;
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                along.emplace_back(std::min(nodes[i], nodes[i + 1]), std::max(nodes[i], nodes[i + 1]));
            }
        }
    }
    return lines_off(given.faces[face.index()], std::move(along));
}

}  // namespace pavior::detail

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/detail/given_lines-inl.hpp>
#endif
