#pragma once
/// \file
/// Structured quads inside polygons whose corners are near multiples of 90 degrees.

#include <pavior/core/compiled.hpp>
#include <pavior/lattice/logical_grid.hpp>
#include <pavior/lattice/submap_corners.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/report.hpp>

#include <complex>
#include <span>
#include <vector>

namespace pavior {

struct SubmapPolygonOptions {
    CornerOptions corners;
    bool repair = true;  ///< untangle folded quads, the boundary fixed
    int max_shift = 8;   ///< a hole is tried at so many lattice steps round the place estimated, >= 0
};

/// Quads of a polygon. The lattice has axes s, along the first segment of the outer loop, and t, to the left of it.
struct PolygonQuads {
    std::vector<Vec2> nodes;                        ///< in the order of the lattice, s fastest
    std::vector<LatticePoint<2>> lattice;           ///< per node: (s, t); the first point of the outer loop is (0, 0)
    std::vector<QuadCorners> quads;                 ///< counter-clockwise, in the order of the lattice
    std::vector<std::vector<Index>> loops;          ///< per loop and point of the input: its node
    std::vector<std::vector<CornerClass>> classes;  ///< per loop and point
    SmoothReport smooth;
};

/// Fills a polygon with quads on a lattice whose boundary nodes are the points of the loops, with known classes.
/// \param loops   the outer one first, counter-clockwise, holes clockwise; at least four points each
/// \param classes per loop and point. The quarter turns of the outer loop must sum up to 4, those of holes to -4, and
///                segments along each direction must be as many as against it.
/// Inner nodes are placed by a harmonic map (place_inner_nodes()) and have four quads each.
/// \throws UnmeshableError infeasible_intervals (a loop does not close), not_submappable (no room on the lattice; ids:
/// the loop); InputError empty_input, size_mismatch, not_finite.
[[nodiscard]] PAVIOR_INLINE PolygonQuads submap_polygon(std::span<const std::vector<Vec2>> loops,
                                                        std::span<const std::vector<CornerClass>> classes,
                                                        const SubmapPolygonOptions& options = {});

/// The same with the classes of least total deviation (classify_loop()): every point is judged by the angle there.
/// \throws also UnmeshableError not_submappable if the corners of a loop are not those of a union of rectangles.
[[nodiscard]] PAVIOR_INLINE PolygonQuads submap_polygon(std::span<const std::vector<Vec2>> loops,
                                                        const SubmapPolygonOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/submap_polygon-inl.hpp>
#endif
