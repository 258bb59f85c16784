#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/intervals/interval_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE EqualEdges::EqualEdges(const IntervalSystem& system, const std::vector<std::size_t>& active)
    : class_(system.edges.size()) {
    DisjointSets<std::size_t> sets(class_.size());
    for (const std::size_t i : active) {
        const IntervalRule& rule = system.rules[i];
        if (rule.kind == IntervalRule::Kind::equal && rule.value == 0 && rule.terms.size() == 2 &&
            rule.terms[0].second == -rule.terms[1].second) {
            sets.unite(rule.terms[0].first, rule.terms[1].first);
        }
    }
    for (std::size_t i = 0; i < class_.size(); ++i) {
        class_[i] = sets.root(i);
    }
}

PAVIOR_INLINE std::vector<int> cost_breakpoints(int lower, const std::vector<double>& wishes) {
    double top = lower + 1.0;
    std::vector<int> result;
    for (const double wish : wishes) {
        top = std::max(top, std::ceil(wish) + 2.0);
        result.push_back(std::max(lower, static_cast<int>(std::floor(wish))));
        result.push_back(std::max(lower, static_cast<int>(std::ceil(wish))));
    }
    for (int n = lower; n <= top; n = std::max(n + 1, static_cast<int>(n * 1.15))) {
        result.push_back(n);
    }
    result.push_back(static_cast<int>(top));
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

PAVIOR_INLINE IntervalProgram::IntervalProgram(const IntervalSystem& system, const std::vector<std::size_t>& active,
                                               bool with_cost)
    : system_(system), classes_(system, active), variable_(system.edges.size()) {
    program_.relative_gap = 1e-3;
    add_classes(with_cost);
    for (const std::size_t i : active) {
        add_rule(system.rules[i]);
    }
}

PAVIOR_INLINE std::vector<int> IntervalProgram::numbers(const IntegerSolution& solution) const {
    std::vector<int> result(system_.edges.size());
    for (std::size_t e = 0; e < result.size(); ++e) {
        result[e] = static_cast<int>(std::lround(solution.values[variable_[classes_[e]]]));
    }
    return result;
}

PAVIOR_INLINE void IntervalProgram::add_classes(bool with_cost) {
    std::vector<std::vector<std::size_t>> members(system_.edges.size());
    for (std::size_t e = 0; e < members.size(); ++e) {
        members[classes_[e]].push_back(e);
    }
    for (std::size_t e = 0; e < members.size(); ++e) {
        if (members[e].empty()) {
            continue;
        }
        int lower = 1;
        std::vector<double> wishes;
        for (const std::size_t member : members[e]) {
            lower = std::max(lower, system_.edges[member].lower);
            wishes.push_back(system_.edges[member].wish);
        }
        variable_[e] = program_.add({static_cast<double>(lower), 1e6, 0.0, true, {}});
        if (with_cost) {
            add_cost(variable_[e], lower, wishes);
        }
    }
}

PAVIOR_INLINE void IntervalProgram::add_cost(std::size_t n, int lower, const std::vector<double>& wishes) {
    const std::vector<int> points = cost_breakpoints(lower, wishes);
    const auto cost = [&](int at) {
        double sum = 0.0;
        for (const double wish : wishes) {
            sum += interval_cost(at, wish);
        }
        return sum;
    };
    IntegerProgram::Row row{static_cast<double>(lower), static_cast<double>(lower), {{n, 1.0}}, {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool last = i + 1 == points.size();
        const int from = points[i], to = last ? from + 1 : points[i + 1];
        const double slope = (cost(to) - cost(from)) / (to - from);
        const double length = last ? no_bound : static_cast<double>(to - from);
        row.terms.emplace_back(program_.add({0.0, length, slope, false, {}}), -1.0);
    }
    program_.rows.push_back(std::move(row));
}

PAVIOR_INLINE void IntervalProgram::add_rule(const IntervalRule& rule) {
    std::vector<int> sums(program_.variables.size(), 0);
    for (const auto& [edge, coefficient] : rule.terms) {
        sums[variable_[classes_[edge]]] += coefficient;
    }
    const double value = rule.value;
    IntegerProgram::Row row{value, rule.kind == IntervalRule::Kind::at_least ? no_bound : value, {}, rule.text};
    for (std::size_t j = 0; j < sums.size(); ++j) {
        if (sums[j] != 0) {
            row.terms.emplace_back(j, sums[j]);
        }
    }
    if (rule.kind == IntervalRule::Kind::even) {
        row.lower = row.upper = 0.0;
        row.terms.emplace_back(program_.add({-no_bound, no_bound, 0.0, true, {}}), -2.0);
    } else if (row.terms.empty() && row.lower <= 0.0 && row.upper >= 0.0) {
        return;
    }
    program_.rows.push_back(std::move(row));
}

}  // namespace detail

}  // namespace pavior
