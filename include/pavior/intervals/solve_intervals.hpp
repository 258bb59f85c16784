#pragma once
/// \file
/// The best numbers of intervals for a system of rules, or the rules that contradict each other.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/intervals/interval_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Whether the equal and even rules among \p active have a solution modulo 2. Gaussian elimination, O(r^2 n / 64).
[[nodiscard]] PAVIOR_INLINE bool parity_possible(const IntervalSystem& system, const std::vector<std::size_t>& active);

}  // namespace detail

/// The numbers found for a system.
struct IntervalResult {
    ProgramStatus status = ProgramStatus::unsolved;
    std::vector<int> numbers;        ///< per edge; empty unless the status is optimal or feasible
    double objective = 0.0;          ///< sum of interval_cost over the edges
    std::vector<std::size_t> rules;  ///< if infeasible: the rules (ascending) of the part that has no solution
};

namespace detail {

/// Whether the rules contradict each other, for certain.
template <integer_solver Solver>
[[nodiscard]] bool contradict(const IntervalSystem& system, const std::vector<std::size_t>& active, Solver&& solver) {
    if (!parity_possible(system, active)) {
        return true;
    }
    const IntegerSolution solution = solver(IntervalProgram(system, active, false).program());
    return solution.status == ProgramStatus::infeasible;
}

/// The best number for an edge that no rule binds.
[[nodiscard]] inline int best_alone(const IntervalEdge& edge) {
    const int n = std::max(edge.lower, static_cast<int>(std::floor(edge.wish)));
    return interval_cost(n + 1, edge.wish) < interval_cost(n, edge.wish) ? n + 1 : n;
}

/// The rules of each connected part of the system, so that parts are solved on their own.
[[nodiscard]] PAVIOR_INLINE std::vector<std::vector<std::size_t>> connected_rules(const IntervalSystem& system);

/// The part of a system made of some rules and the edges that they tie together.
struct SystemPart {
    IntervalSystem system;
    std::vector<std::size_t> edges;  ///< of the whole system
};

[[nodiscard]] PAVIOR_INLINE SystemPart system_part(const IntervalSystem& whole, const std::vector<std::size_t>& rules);

}  // namespace detail

/// Numbers of intervals that satisfy all rules with the least sum of interval_cost. Costs are exact at all integers up
/// to the wish where wishes are small (below about 7) and next to each wish, and linear between numbers 15 % apart
/// otherwise. Edges without a rule take the best number by themselves; unconnected parts are solved one by one.
/// \p solver turns an IntegerProgram into an IntegerSolution, e.g. `solve`. Deterministic if the solver is.
template <integer_solver Solver>
[[nodiscard]] IntervalResult solve_intervals(const IntervalSystem& system, Solver&& solver) {
    IntervalResult result;
    result.status = ProgramStatus::optimal;
    result.numbers.resize(system.edges.size(), 0);
    for (const std::vector<std::size_t>& rules : detail::connected_rules(system)) {
        const detail::SystemPart part = detail::system_part(system, rules);
        std::vector<std::size_t> all(rules.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        const detail::IntervalProgram program(part.system, all, true);
        IntegerSolution solution{ProgramStatus::infeasible, 0.0, {}};
        if (detail::parity_possible(part.system, all)) {
            solution = solver(program.program());
        }
        if (!solution.found()) {
            return {solution.status, {}, 0.0, rules};
        }
        if (solution.status == ProgramStatus::feasible) {
            result.status = ProgramStatus::feasible;
        }
        const std::vector<int> numbers = program.numbers(solution);
        for (std::size_t e = 0; e < numbers.size(); ++e) {
            result.numbers[part.edges[e]] = numbers[e];
        }
    }
    for (std::size_t e = 0; e < system.edges.size(); ++e) {
        if (result.numbers[e] == 0) {
            result.numbers[e] = detail::best_alone(system.edges[e]);
        }
        result.objective += interval_cost(result.numbers[e], system.edges[e].wish);
    }
    return result;
}

/// Of the rules \p active, which contradict each other, a subset that still does, although no proper part of it does
/// as far as parity and the solver can tell. About r log r calls of the solver for a subset of r rules.
template <integer_solver Solver>
[[nodiscard]] std::vector<std::size_t> conflicting_rules(const IntervalSystem& system, std::vector<std::size_t> active,
                                                         Solver&& solver) {
    for (std::size_t chunk = std::max<std::size_t>(active.size() / 2, 1); chunk > 0; chunk /= 2) {
        for (std::size_t at = 0; at < active.size();) {
            const std::size_t end = std::min(at + chunk, active.size());
            std::vector<std::size_t> rest(active.begin(), active.begin() + static_cast<std::ptrdiff_t>(at));
            rest.insert(rest.end(), active.begin() + static_cast<std::ptrdiff_t>(end), active.end());
            if (detail::contradict(system, rest, solver)) {
                active = std::move(rest);
            } else {
                at = end;
            }
        }
    }
    return active;
}

namespace detail {

/// Why \p failed has no numbers.
template <integer_solver Solver>
[[nodiscard]] UnmeshableError interval_error(const IntervalSystem& system, const IntervalResult& failed,
                                             Solver& solver) {
    if (failed.status != ProgramStatus::infeasible) {
        return {ErrorCode::infeasible_intervals, "no numbers of intervals were found in the time allowed"};
    }
    std::string text = "these demands contradict each other:";
    std::set<int> faces;
    for (const std::size_t i : conflicting_rules(system, failed.rules, solver)) {
        text += "\n  " + system.rules[i].text;
        faces.insert(system.rules[i].faces.begin(), system.rules[i].faces.end());
    }
    return {ErrorCode::infeasible_intervals, text, Error::Ids(faces.begin(), faces.end())};
}

/// Solves; gives up the angles if they are what makes the system infeasible.
template <integer_solver Solver>
[[nodiscard]] IntervalResult solve_relaxing_angles(IntervalSystem& system, Solver& solver, bool& angles_kept) {
    IntervalResult result = solve_intervals(system, solver);
    if (result.status == ProgramStatus::infeasible) {
        for (IntervalEdge& edge : system.edges) {
            angles_kept = angles_kept && edge.lower == 1;
            edge.lower = 1;
        }
        result = angles_kept ? result : solve_intervals(system, solver);
    }
    if (result.numbers.empty() && !system.edges.empty()) {
        throw interval_error(system, result, solver);
    }
    return result;
}

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/intervals/solve_intervals-inl.hpp>
#endif
