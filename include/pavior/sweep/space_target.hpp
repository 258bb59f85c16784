#pragma once
/// \file
/// The mesh of a target cap in space: without a surface, or on one whose parameters cannot be used.

#include <pavior/core/compiled.hpp>
#include <pavior/math/affine_map.hpp>
#include <pavior/math/point.hpp>
#include <pavior/sweep/target_projection.hpp>

#include <functional>
#include <span>
#include <vector>

namespace pavior {

/// The target mesh made in space, and its report.
struct SpaceTargetMesh {
    std::vector<Vec3> nodes;           ///< in the order of the source nodes
    AffineMap<double, 3> map;          ///< the constrained map of the loops
    double residual = 0.0;             ///< max |y - map(x)| over the loop nodes, unit of the coordinates
    bool corrected = false;            ///< the boundary correction is in
    std::vector<Index> folded_by_map;  ///< quads that the affine map alone folds, ascending
    SmoothReport smooth;               ///< of the untangling; iterations 0 if there was none to do
    std::vector<Index> folded;         ///< quads still folded, ascending
};

/// Maps the source mesh to a target cap known by its loops alone: the inner nodes go through the constrained affine map
/// of the loops in space (affine/constrained.hpp), which keeps the bulge of the source; the loop nodes are the given
/// ones, bit by bit. Quads that fold, seen from the normals that the map gives to them, are repaired as in
/// project_target(): boundary residual spread over the inner nodes, then untangling in the plane perpendicular to the
/// target's pseudo-normal with the heights above it kept.
/// \param source     its `uv` is not read and may be empty
/// \param loop_nodes target positions of the nodes source.loops.nodes, in that order
/// InputError: size_mismatch, bad_index, not_finite, empty_input; null_pseudo_area, source_degenerate,
/// target_degenerate, unrelated_loops where the loops determine no map. Quads that stay folded are reported.
/// O(n), with the correction O(inner x loop nodes); thread-safe.
[[nodiscard]] PAVIOR_INLINE SpaceTargetMesh project_target_in_space(const SourceCap& source,
                                                                    std::span<const Vec3> loop_nodes,
                                                                    const TargetOptions& options = {});

/// The same with every inner node moved by \p place to the target surface, e.g. to the closest point: for surfaces
/// whose parameters are of no use on the cap, such as one with a pole in the middle. The surface should be nearly
/// parallel to the plane of the loop, or bulge like the source does: points of a flat disc are far from a hemisphere.
[[nodiscard]] PAVIOR_INLINE SpaceTargetMesh project_target_in_space(const std::function<Vec3(const Vec3&)>& place,
                                                                    const SourceCap& source,
                                                                    std::span<const Vec3> loop_nodes,
                                                                    const TargetOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/space_target-inl.hpp>
#endif
