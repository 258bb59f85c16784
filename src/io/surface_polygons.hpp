#pragma once
// Polygons to triangles.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <span>
#include <vector>

namespace pavior::io {

/// Cuts a simple polygon, not quite plane perhaps, into triangles of the same sense and appends them.
void cut_polygon(std::span<const Vec3> nodes, std::span<const Index> corners, std::vector<TriCorners>& triangles);

}  // namespace pavior::io
