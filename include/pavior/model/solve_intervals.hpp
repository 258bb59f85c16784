#pragma once
/// \file
/// The best numbers of intervals for a system of rules, or the rules that contradict each other.

#include <pavior/model/interval_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Whether the equal and even rules among \p active have a solution modulo 2 (Gaussian elimination).
[[nodiscard]] inline bool parity_possible(const IntervalSystem& system, const std::vector<std::size_t>& active) {
    std::vector<std::pair<std::size_t, std::vector<bool>>> pivots;  // pivot column and reduced row
    const std::size_t n = system.edges.size();
    for (const std::size_t i : active) {
        const IntervalRule& rule = system.rules[i];
        if (rule.kind == IntervalRule::Kind::at_least) {
            continue;
        }
        std::vector<bool> row(n + 1, false);  // the last column is the right-hand side
        for (const auto& [edge, coefficient] : rule.terms) {
            row[edge] = row[edge] != (coefficient % 2 != 0);
        }
        row[n] = rule.kind == IntervalRule::Kind::equal && rule.value % 2 != 0;
        for (const auto& [column, pivot] : pivots) {
            if (row[column]) {
                for (std::size_t j = 0; j <= n; ++j) {
                    row[j] = row[j] != pivot[j];
                }
            }
        }
        const auto column = static_cast<std::size_t>(std::find(row.begin(), row.end(), true) - row.begin());
        if (column == n) {
            return false;
        }
        if (column < n) {
            pivots.emplace_back(column, std::move(row));
        }
    }
    return true;
}

}  // namespace detail

/// The numbers found for a system, or the rules that contradict each other.
struct IntervalResult {
    std::vector<int> numbers;            ///< per edge; empty if none were found
    double objective = 0.0;              ///< sum of interval_cost over the edges
    bool optimal = false;                ///< proven best
    std::vector<std::size_t> conflict;   ///< if infeasible: rules (ascending) that cannot hold together
};

namespace detail {

/// Whether the rules contradict each other, for certain.
template <class Solver>
[[nodiscard]] bool contradict(const IntervalSystem& system, const std::vector<std::size_t>& active, Solver& solver) {
    return !parity_possible(system, active) ||
           solver(IntervalProgram(system, active, false).program()).status == ProgramStatus::infeasible;
}

/// Drops rules from \p active, in chunks of falling size, as long as the rest still contradicts itself.
template <class Solver>
[[nodiscard]] std::vector<std::size_t> reduce_conflict(const IntervalSystem& system, std::vector<std::size_t> active,
                                                       Solver& solver) {
    for (std::size_t chunk = std::max<std::size_t>(active.size() / 2, 1); chunk > 0; chunk /= 2) {
        for (std::size_t at = 0; at < active.size();) {
            std::vector<std::size_t> rest(active.begin(), active.begin() + static_cast<std::ptrdiff_t>(at));
            const std::size_t end = std::min(at + chunk, active.size());
            rest.insert(rest.end(), active.begin() + static_cast<std::ptrdiff_t>(end), active.end());
            if (contradict(system, rest, solver)) {
                active = std::move(rest);
            } else {
                at += chunk;
            }
        }
    }
    return active;
}

/// The rules of each connected part of the system, so that parts are solved on their own.
[[nodiscard]] inline std::vector<std::vector<std::size_t>> connected_rules(const IntervalSystem& system) {
    std::vector<std::size_t> parent(system.edges.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) {
            i = parent[i] = parent[parent[i]];
        }
        return i;
    };
    for (const IntervalRule& rule : system.rules) {
        for (const auto& [edge, coefficient] : rule.terms) {
            parent[root(edge)] = root(rule.terms[0].first);
        }
    }
    std::vector<std::vector<std::size_t>> by_root(system.edges.size() + 1);
    for (std::size_t i = 0; i < system.rules.size(); ++i) {
        const auto& terms = system.rules[i].terms;
        by_root[terms.empty() ? system.edges.size() : root(terms[0].first)].push_back(i);
    }
    std::erase_if(by_root, [](const auto& rules) { return rules.empty(); });
    return by_root;
}

/// The part of a system made of some rules and the edges that they tie together.
struct SystemPart {
    IntervalSystem system;
    std::vector<std::size_t> edges;  ///< of the whole system
};

[[nodiscard]] inline SystemPart system_part(const IntervalSystem& whole, const std::vector<std::size_t>& rules) {
    SystemPart part;
    std::vector<std::size_t> index(whole.edges.size(), whole.edges.size());
    for (const std::size_t i : rules) {
        IntervalRule rule = whole.rules[i];
        for (auto& [edge, coefficient] : rule.terms) {
            if (index[edge] == whole.edges.size()) {
                index[edge] = part.edges.size();
                part.edges.push_back(edge);
                part.system.edges.push_back(whole.edges[edge]);
            }
            edge = index[edge];
        }
        part.system.rules.push_back(std::move(rule));
    }
    return part;
}

}  // namespace detail

/// Numbers of intervals that satisfy all rules with the least sum of interval_cost. Costs are exact at all integers up
/// to the wish where wishes are small (below about 7) and next to each wish, and linear between numbers 15 % apart
/// otherwise. Edges without a rule take the best number by themselves; unconnected parts are solved one by one.
/// \p solver turns an IntegerProgram into an IntegerSolution, e.g. `solve`. Deterministic if the solver is.
/// If no numbers are found and none can be proven missing (time is up), both `numbers` and `conflict` are empty.
template <class Solver>
[[nodiscard]] IntervalResult solve_intervals(const IntervalSystem& system, Solver&& solver) {
    IntervalResult result;
    result.optimal = true;
    result.numbers.resize(system.edges.size(), 0);
    for (const std::vector<std::size_t>& rules : detail::connected_rules(system)) {
        const detail::SystemPart part = detail::system_part(system, rules);
        std::vector<std::size_t> all(rules.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        const detail::IntervalProgram program(part.system, all, true);
        IntegerSolution solution;
        if (detail::parity_possible(part.system, all)) {
            solution = solver(program.program());
        } else {
            solution.status = ProgramStatus::infeasible;
        }
        if (!solution.found()) {
            result = {};
            if (solution.status == ProgramStatus::infeasible) {
                for (const std::size_t i : detail::reduce_conflict(part.system, all, solver)) {
                    result.conflict.push_back(rules[i]);
                }
            }
            return result;
        }
        result.optimal = result.optimal && solution.status == ProgramStatus::optimal;
        const std::vector<int> numbers = program.numbers(solution);
        for (std::size_t e = 0; e < numbers.size(); ++e) {
            result.numbers[part.edges[e]] = numbers[e];
        }
    }
    for (std::size_t e = 0; e < system.edges.size(); ++e) {
        int& n = result.numbers[e];
        if (n == 0) {
            const double wish = system.edges[e].wish;
            n = std::max(system.edges[e].lower, static_cast<int>(std::floor(wish)));
            n += interval_cost(n + 1, wish) < interval_cost(n, wish) ? 1 : 0;
        }
        result.objective += interval_cost(n, system.edges[e].wish);
    }
    return result;
}

}  // namespace pavior
