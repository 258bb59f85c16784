#pragma once
/// \file
/// How far the quads of a boundary are from a surface of triangles, and what that surface encloses.

#include <pavior/core/compiled.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <span>

namespace pavior {

/// Largest distance of a corner or a centre of \p quads from the nearest of \p triangles; 0 without either.
/// O(n log n) for points close to them. \throws InputError bad_index (a corner of a triangle or quad without a node)
[[nodiscard]] PAVIOR_INLINE double surface_distance(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                                    std::span<const Vec3> surface_nodes,
                                                    std::span<const TriCorners> triangles);

/// The volume that closed \p triangles enclose, counter-clockwise seen from outside. O(n).
/// \throws InputError bad_index (a corner without a node)
[[nodiscard]] PAVIOR_INLINE double enclosed_volume(std::span<const Vec3> nodes, std::span<const TriCorners> triangles);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/surface_distance-inl.hpp>
#endif
