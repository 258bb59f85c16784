#pragma once
// Exact crossings and faces of segments; CGAL stays in the source file. Internal to imprint.

#include "snap.hpp"

namespace pavior::detail {

/// Cuts the segments of the routes where they cross each other and adds the crossings to the points. True if any did.
bool cut_crossings(Routes& routes);

/// Boundaries of the faces of segments that meet in common ends only, each a closed walk over points with the face on
/// the left: for each bounded face the outer walk first, then its holes. No walk of the unbounded face.
using Walk = std::vector<Index>;
[[nodiscard]] std::vector<std::vector<Walk>> faces(const Routes& routes);

}  // namespace pavior::detail
