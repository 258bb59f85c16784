#pragma once
// From the boundary curves of a face in its parameter plane to oriented loops. Knows nothing of any CAD kernel.

#include <pavior/math/point.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace pavior::detail {

/// One use of an edge by a face: its curve in the parameter plane, sampled along the edge's own parameter.
struct BoundaryCurve {
    std::array<std::size_t, 2> vertices;  ///< at the first and the last sample
    std::vector<Vec2> uv;
};

/// A curve of the list, run along (true) or against its samples.
struct DirectedCurve {
    std::size_t curve;
    bool forward;
};

using CurveLoop = std::vector<DirectedCurve>;

/// Chains the curves of one face into closed loops: ends meet at a common vertex and, where several do, at the nearest
/// parameters. The loop with the largest area comes first and runs counter-clockwise, the others clockwise.
/// Nothing if a chain does not close in the parameter plane (relative to \p scale, the extent of the parameters).
std::optional<std::vector<CurveLoop>> chain_curves(const std::vector<BoundaryCurve>& curves, const Vec2& scale);

/// The area in the parameter plane that \p loop encloses, counter-clockwise positive.
double enclosed_area(const std::vector<BoundaryCurve>& curves, const CurveLoop& loop);

/// A point strictly inside the loops: the middle of the widest interval of a scan line.
Vec2 interior_point(const std::vector<BoundaryCurve>& curves);

}  // namespace pavior::detail
