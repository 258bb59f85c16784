#pragma once
/// \file
/// The mesh of the target cap: the source mesh mapped by an affine map between the loops, on the target surface.

#include <pavior/core/compiled.hpp>
#include <pavior/math/affine_map.hpp>
#include <pavior/math/any_surface.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>
#include <pavior/sweep/boundary_error.hpp>

#include <span>
#include <vector>

namespace pavior {

/// When the inner nodes follow what the affine map leaves over at the boundary: the residuals of the loop nodes are
/// interpolated to them over the source cap, so that the map with its correction interpolates the loops. Section 4.2.2
/// \cite roca2009 has none and smooths where quads fold.
enum class TargetCorrection : std::uint8_t {
    never,
    when_folded,  ///< if the map itself folds quads, and no more of them fold with the correction
    always,
};

struct TargetOptions {
    TargetCorrection correction = TargetCorrection::when_folded;
    /// How residuals are interpolated; none: as TargetCorrection::never.
    BoundaryCorrection by = BoundaryCorrection::idw;
    /// Untangle quads that are still folded. With no correction and untangle false the result is the plain map.
    bool untangle = true;
    /// If the affine map folds quads, also smooth what the correction and the untangling have made of it: all inner
    /// nodes, the smallest determinant never gets worse. Nothing happens where the map alone folds nothing.
    bool smooth_repaired = false;
    /// How to untangle; `reversed` is set by the function.
    UntangleOptions untangling;
};

/// The source cap as arrays. Nodes are numbered alike on both caps.
struct SourceCap {
    std::span<const Vec3> nodes;         ///< positions in space
    std::span<const Vec2> uv;            ///< their parameters, continuous across a seam; or plane_coordinates()
    std::span<const QuadCorners> quads;  ///< one orientation for all; may be empty: then no quad can be seen to fold
    const Loops& loops;                  ///< the boundary of the quads
};

/// The target mesh and its report.
struct TargetMesh {
    std::vector<Vec3> nodes;           ///< in the order of the source nodes
    std::vector<Vec2> uv;              ///< parameters on the target surface
    AffineMap<double, 2> map;          ///< F of the loops in the parameter planes, eq. (4.5) \cite roca2009
    double residual = 0.0;             ///< max |u_T - map(u_S)| over the loop nodes, unit of the parameters
    bool reversed = false;             ///< quads run clockwise in the target's parameter plane
    bool corrected = false;            ///< the boundary correction is in
    std::vector<Index> folded_by_map;  ///< quads that the affine map alone folds, ascending
    SmoothReport smooth;               ///< of the untangling; iterations 0 if there was none to do
    std::vector<Index> folded;         ///< quads still folded, ascending
};

/// Coordinates of a cap in a plane, for a source without a surface: along two orthonormal axes perpendicular to the
/// vector area of the quads, about the mean of the nodes; quads of a nearly flat cap run counter-clockwise.
/// InputError (null_pseudo_area) if the quads enclose no area. O(n).
[[nodiscard]] PAVIOR_INLINE std::vector<Vec2> plane_coordinates(std::span<const Vec3> nodes,
                                                                std::span<const QuadCorners> quads);

/// Maps the source mesh to the target surface, section 4.2.2 \cite roca2009: the inner nodes go through the affine map
/// F fitted to the loops in the two parameter planes (4.5), then through the target's parametrisation (4.6); nodes and
/// parameters of the loops are the given ones, bit by bit. F interpolates the loops only if they are affine to each
/// other. Where quads fold (folded_quads.hpp), the boundary residual is spread over the inner nodes and what is left is
/// untangled on the surface, the boundary fixed and the source quads as the wanted shapes; see TargetOptions. A node
/// outside the target cannot be there without a folded quad. The target's own normal may point either way.
/// \param target     the target surface, any parametric_surface
/// \param loop_uv    target parameters of the nodes source.loops.nodes, in that order, continuous across a seam
///                   (unwrap.hpp)
/// \param loop_nodes their positions in space
/// InputError: size_mismatch, bad_index, not_finite, empty_input. Quads that stay folded are reported. O(n), with the
/// correction O(inner x loop nodes). As thread-safe as the surface.
[[nodiscard]] PAVIOR_INLINE TargetMesh project_target(const AnySurface& target, const SourceCap& source,
                                                      std::span<const Vec2> loop_uv, std::span<const Vec3> loop_nodes,
                                                      const TargetOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/target_projection-inl.hpp>
#endif
