#pragma once
// Triangles of a solid, turned outwards. Internal to the cad component.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <span>
#include <vector>

namespace pavior::detail {

/// Turns the triangles that bound one solid, each in either sense, so that they are counter-clockwise seen from
/// outside: alike along every edge, the shell of the largest volume positive, the others (cavities) negative.
/// Returns the triangles on edges that have not exactly two triangles; empty: all is well.
std::vector<std::size_t> orient_shells(std::span<const Vec3> nodes, std::span<TriCorners> triangles);

}  // namespace pavior::detail
