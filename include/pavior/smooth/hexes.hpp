#pragma once
/// \file
/// Untangles and optimises hexahedra, boundary fixed.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Moves nodes until no hexahedron is inverted: the tetrahedra of its eight corners and the Jacobian at its centre are
/// positive (options.positivity: at 27 points). As untangle_quads(), one dimension up, \cite garanzha2021.
///
/// Only what needs to be moved is moved: a mesh without inverted hexahedra is returned as it is (unless
/// options.always), and otherwise the nodes round the inverted ones are freed ring by ring. Never worse than the input:
/// the number of inverted hexahedra does not grow, and with options.always the smallest determinant does not shrink.
/// \param nodes      coordinates, in and out. Any unit: the result scales and moves with the input (up to rounding).
/// \param hexes      corners, numbered as HexCorners.
/// \param fixed      one flag per node; 0: may move. Fixed nodes do not change by a bit. As a rule the boundary.
/// \param reference  empty, or one point per node: the shape each hexahedron should take; any scale. Empty: cubes of
///                   the mean volume. Corners that are degenerate or inverted in it count as those of cubes.
/// \return the report. A hexahedron with an inverted corner between fixed nodes cannot be repaired: it is reported.
/// \throws InputError size_mismatch, bad_index, not_finite, bad_option; Stopped. The nodes are as they were then.
/// O(hexahedra) plus O(nodes freed) per iteration; about 300 bytes per hexahedron freed. The result does not depend on
/// options.execution. Not to be called on one mesh from two threads.
PAVIOR_INLINE SmoothReport untangle_hexes(std::span<Vec3> nodes, std::span<const HexCorners> hexes,
                                          std::span<const std::uint8_t> fixed, const UntangleOptions& options = {},
                                          std::span<const Vec3> reference = {});

/// Untangled nodes of a mesh that stays as it is.
struct UntangledHexes {
    std::vector<Vec3> nodes;  ///< as many, in the same order
    SmoothReport report;
};

/// The same for any hex_mesh, which is not changed.
template <hex_mesh M>
[[nodiscard]] UntangledHexes untangle_hexes(const M& mesh, std::span<const std::uint8_t> fixed,
                                            const UntangleOptions& options = {}, std::span<const Vec3> reference = {}) {
    HexMesh copy = to_hex_mesh(mesh);
    SmoothReport report =
        untangle_hexes(std::span(copy.nodes), std::span<const HexCorners>(copy.hexes), fixed, options, reference);
    return {std::move(copy.nodes), std::move(report)};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/hexes-inl.hpp>
#endif
