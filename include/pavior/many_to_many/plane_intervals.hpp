#pragma once
/// \file
/// Numbers of mesh edges on the edges of an arrangement, so that every cell can be filled with quads.

#include <pavior/core/compiled.hpp>
#include <pavior/intervals/solve_intervals.hpp>
#include <pavior/many_to_many/plane_arrangement.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Numbers of intervals of the edges of an arrangement.
struct PlaneIntervals {
    std::vector<int> numbers;  ///< one an edge
    std::size_t mapped = 0;    ///< cells with four corners whose opposite sides are equal
    double worst_ratio = 1.0;  ///< largest deviation from the wish, max(n / wish, wish / n)
    bool optimal = true;
};

namespace detail {

/// Length, and the angle by which it turns, of a polyline.
struct PolylineSize {
    double length = 0;
    double turning = 0;  ///< radians, absolute values added
};

[[nodiscard]] PAVIOR_INLINE PolylineSize polyline_size(std::span<const Vec2> points);

/// The rules for all cells; those of four-sided cells, which may be given up, come last.
[[nodiscard]] PAVIOR_INLINE IntervalSystem plane_interval_system(const PlaneArrangement& plane,
                                                                 std::span<const char> wanted,
                                                                 std::span<const double> edge_sizes, double max_angle,
                                                                 std::span<const char> given);

[[nodiscard]] PAVIOR_INLINE std::vector<IntervalRule> mapping_rules(const PlaneArrangement& plane,
                                                                    std::span<const char> wanted);

/// The mapping rules of cells without an edge that is given.
[[nodiscard]] PAVIOR_INLINE std::vector<IntervalRule> free_mapping_rules(const PlaneArrangement& plane,
                                                                         std::span<const char> wanted,
                                                                         std::span<const char> given);

[[nodiscard]] PAVIOR_INLINE double worst_interval_ratio(const IntervalSystem& system, const std::vector<int>& numbers);

}  // namespace detail

/// Divides the edges of \p plane into intervals of about edge_sizes[e] that turn by at most \p max_angle (radians)
/// each: every loop of a cell that is \p wanted (one flag each) gets an even number, at least four. Cells with four
/// corners get equal opposite sides, so that they can be filled with a grid, unless all together that is impossible or
/// makes some edge's number deviate from its wish by more than a factor of three more than without. Edges that are \p
/// given (one flag each; empty: none) get one interval; a cell of four of them is bound by no rule. Where equal
/// opposite sides contradict them, only cells without given edges keep theirs. \p solver turns an IntegerProgram into
/// an IntegerSolution.
/// \throws UnmeshableError infeasible_intervals where the solver fails, or the given edges leave no numbers (without
/// them numbers exist always: all edges even)
template <integer_solver Solver>
[[nodiscard]] PlaneIntervals plane_intervals(const PlaneArrangement& plane, std::span<const char> wanted,
                                             std::span<const double> edge_sizes, double max_angle, Solver&& solver,
                                             std::span<const char> given = {}) {
    IntervalSystem system = detail::plane_interval_system(plane, wanted, edge_sizes, max_angle, given);
    const std::size_t loops = system.rules.size();
    for (IntervalRule& rule : detail::mapping_rules(plane, wanted)) {
        system.rules.push_back(std::move(rule));
    }
    PlaneIntervals result;
    IntervalResult solved = solve_intervals(system, solver);
    if (solved.numbers.empty() && !given.empty()) {
        system.rules.resize(loops);
        for (IntervalRule& rule : detail::free_mapping_rules(plane, wanted, given)) {
            system.rules.push_back(std::move(rule));
        }
        solved = solve_intervals(system, solver);
    }
    result.mapped = (system.rules.size() - loops) / 2;
    const double mapped_ratio = detail::worst_interval_ratio(system, solved.numbers);
    if (result.mapped > 0 && (solved.numbers.empty() || mapped_ratio > 3)) {
        IntervalSystem plain = system;
        plain.rules.resize(loops);
        IntervalResult other = solve_intervals(plain, solver);
        if (solved.numbers.empty() ||
            (!other.numbers.empty() && 3 * detail::worst_interval_ratio(plain, other.numbers) < mapped_ratio)) {
            solved = std::move(other);
            result.mapped = 0;
        }
    }
    if (solved.numbers.empty() && !plane.edges.empty()) {
        throw detail::interval_error(system, solved, solver);
    }
    result.numbers = solved.numbers;
    result.optimal = solved.status == ProgramStatus::optimal;
    result.worst_ratio = detail::worst_interval_ratio(system, solved.numbers);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/plane_intervals-inl.hpp>
#endif
