#pragma once
/// \file
/// Interval assignment: how many mesh edges each edge of a model gets, so that swept solids can be meshed and fit
/// together.

#include <pavior/core/compiled.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/intervals/solve_intervals.hpp>
#include <pavior/one_to_one/interval_rules.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

struct IntervalAssignment {
    std::vector<int> intervals;  ///< per edge id; 0 for edges that bound none of the solids
    std::vector<int> layers;     ///< per sweep
    double objective = 0.0;      ///< sum of interval_cost over the edges
    double mean_ratio = 1.0;     ///< mean of max(n / wish, wish / n)
    double worst_ratio = 1.0;    ///< largest of them
    EdgeId worst_edge;           ///< where
    bool optimal = true;         ///< proven within the solver's gap
    bool angles_kept = true;     ///< max_angle holds everywhere
};

namespace detail {

/// What \p solved says about the edges, which come first in \p system, and the sweeps.
PAVIOR_INLINE void fill_assignment(const IntervalSystem& system, const std::vector<EdgeId>& edges,
                                   std::span<const SweepTopology> sweeps, std::size_t edge_count,
                                   const IntervalResult& solved, IntervalAssignment& result);

}  // namespace detail

/// Assigns numbers of intervals to all edges of the solids of \p sweeps (one model, each solid at most once), the
/// solids taken together so that shared edges agree:
/// opposite logical sides of every linking side are equal (a union of rectangles does not overlap itself either), all
/// loops of a solid have the same number of layers, every loop of a cap is even and has at least min_loop intervals.
/// Among all such numbers the sum of interval_cost, the relative deviation from length / size, is least (within the
/// solver's gap). The wish of an edge is at least its turning over max_angle, and at least 1.
/// A cap that is a linking side of another solid thus gets equal opposite sides as well.
/// Deterministic unless the solver's time limit strikes. \p solver turns an IntegerProgram into an IntegerSolution.
/// \throws UnmeshableError infeasible_intervals if no numbers satisfy the rules; the message lists rules that
/// contradict each other (no proper subset of them does, up to the solver's strength), the ids are the tags of their
/// faces. InputError bad_option for sizes, numbers or angles that are not positive.
template <brep B, integer_solver Solver>
[[nodiscard]] IntervalAssignment assign_intervals(const B& b, std::span<const SweepTopology> sweeps,
                                                  const IntervalOptions& options, Solver&& solver) {
    detail::IntervalBuilder<B> builder(b, sweeps, options);
    IntervalAssignment result;
    const IntervalResult solved = detail::solve_relaxing_angles(builder.system(), solver, result.angles_kept);
    detail::fill_assignment(builder.system(), builder.edges(), sweeps, b.edge_count(), solved, result);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/intervals-inl.hpp>
#endif
