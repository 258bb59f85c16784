#pragma once
/// \file
/// Untangles and optimises quads in a plane, boundary fixed.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Moves nodes until no quad is inverted: at each corner the two edges span a positive area, counter-clockwise. That
/// makes every bilinear quad injective. Foldover-free maps, \cite garanzha2021: the distortion of the corner triangles,
/// regularised so that it is finite on inverted ones, is minimised by L-BFGS while the regularisation is withdrawn.
///
/// Only what needs to be moved is moved: a mesh without inverted quads is returned as it is (unless options.always),
/// and otherwise the nodes round the inverted quads are freed ring by ring. Never worse than the input: the number of
/// inverted quads does not grow, and with options.always the smallest determinant does not shrink.
/// \param nodes      coordinates, in and out. Any unit: the result scales and moves with the input (up to rounding).
/// \param quads      corners; counter-clockwise quads count as positive.
/// \param fixed      one flag per node; 0: may move. Fixed nodes do not change by a bit. As a rule the boundary.
/// \param reference  empty, or one point per node: the shape each quad should take, e.g. the source cap; any scale.
///                   Empty: squares of the mean area. Quads that are degenerate or inverted in it count as squares.
/// \return the report. A quad with a corner between fixed nodes that is inverted cannot be repaired: it is reported.
/// \throws InputError size_mismatch, bad_index, not_finite, bad_option; Stopped. The nodes are as they were then.
/// O(quads) plus O(nodes freed) per iteration. Not to be called on one mesh from two threads.
PAVIOR_INLINE SmoothReport untangle_quads(std::span<Vec2> nodes, std::span<const QuadCorners> quads,
                                          std::span<const std::uint8_t> fixed, const UntangleOptions& options = {},
                                          std::span<const Vec2> reference = {});

/// Untangled nodes of a mesh that stays as it is.
struct UntangledQuads {
    std::vector<Vec3> nodes;  ///< as many, in the same order
    SmoothReport report;
};

/// The same for any quad_mesh, which is not changed, seen along the z axis: x and y move, z stays by the bit.
template <quad_mesh M>
[[nodiscard]] UntangledQuads untangle_quads(const M& mesh, std::span<const std::uint8_t> fixed,
                                            const UntangleOptions& options = {}, std::span<const Vec2> reference = {}) {
    QuadMesh copy = to_quad_mesh(mesh);
    std::vector<Vec2> plane;
    for (const Vec3& x : copy.nodes) {
        plane.emplace_back(x.head<2>());
    }
    SmoothReport report =
        untangle_quads(std::span(plane), std::span<const QuadCorners>(copy.quads), fixed, options, reference);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        copy.nodes[i].head<2>() = plane[i];
    }
    return {std::move(copy.nodes), std::move(report)};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/quads-inl.hpp>
#endif
