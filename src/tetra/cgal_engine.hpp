#pragma once
// CGAL's Delaunay refinement behind plain arrays. Internal to the tetra component.

#include "problem.hpp"

namespace pavior::detail {

/// What the refinement aims at, in the coordinates of the frame.
struct RefinementGoal {
    double edge = 0.0;      ///< length of edges
    double quality = 2.0;   ///< radius-edge ratio
    double degrees = 10.0;  ///< edges sharper than that are kept
};

/// Samples the surface of \p problem anew and fills it. Kept exactly: tagged edges, edges between triangles of
/// different tags or sharper than given (as unions of new edges), their ends, and tagged vertices. Facet numbers name
/// the nearest facet of the complex. Call it in a child: its demands on angles are not always met, and then it does
/// not come back.
[[nodiscard]] RawTets run_cgal(const Problem& problem, const RefinementGoal& goal);

}  // namespace pavior::detail
