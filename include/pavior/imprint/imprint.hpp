#pragma once
/// \file
/// Imprints curves in a plane into each other, with exact arithmetic.

#include <pavior/many_to_many/plane_arrangement.hpp>

namespace pavior {

/// The arrangement of \p curves. Crossings are computed and ordered exactly (CGAL, arrangements of segments); curves
/// that run closer together than options.coincident become one first, then those closer than options.merge: points
/// within the tolerance of an earlier one (ends of curves first, then in the order given) take its place, and segments
/// that pass a point within the tolerance are led through it, until nothing is left to do. So curves join along their
/// length as far as they have points there. The ends of curves, crossings and places where curves join or part are the
/// vertices; all other points are points of edges.
/// Vertices and edges are numbered in the order in which the curves meet them, cells by their first edge.
/// Models plane_imprinter. O((n + k) log n) for n segments with k crossings, a few times over. Deterministic,
/// thread-safe.
/// \throws InputError empty_input (a curve of fewer than two points), not_finite, bad_option (a tolerance that is not
/// finite and positive), size_mismatch (options.merge); Error(cad_failure) if the snapping does not come to rest
[[nodiscard]] PlaneArrangement imprint(const PlaneCurves& curves, const ImprintOptions& options);

}  // namespace pavior
