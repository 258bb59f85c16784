#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/intervals/solve_intervals.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE bool parity_possible(const IntervalSystem& system, const std::vector<std::size_t>& active) {
    using Words = std::vector<std::uint64_t>;
    const std::size_t n = system.edges.size();  // bit n is the right-hand side
    const auto flip = [](Words& row, std::size_t bit) { row[bit / 64] ^= std::uint64_t{1} << (bit % 64); };
    const auto test = [](const Words& row, std::size_t bit) { return ((row[bit / 64] >> (bit % 64)) & 1U) != 0; };
    std::vector<std::pair<std::size_t, Words>> pivots;
    for (const std::size_t i : active) {
        const IntervalRule& rule = system.rules[i];
        if (rule.kind == IntervalRule::Kind::at_least) {
            continue;
        }
        Words row(n / 64 + 1, 0);
        for (const auto& [edge, coefficient] : rule.terms) {
            if (coefficient % 2 != 0) {
                flip(row, edge);
            }
        }
        if (rule.kind == IntervalRule::Kind::equal && rule.value % 2 != 0) {
            flip(row, n);
        }
        for (const auto& [column, pivot] : pivots) {
            if (test(row, column)) {
                std::transform(row.begin(), row.end(), pivot.begin(), row.begin(), std::bit_xor<>());
            }
        }
        std::size_t column = 0;
        while (column <= n && !test(row, column)) {
            ++column;
        }
        if (column == n) {
            return false;
        }
        if (column < n) {
            pivots.emplace_back(column, std::move(row));
        }
    }
    return true;
}

PAVIOR_INLINE std::vector<std::vector<std::size_t>> connected_rules(const IntervalSystem& system) {
    DisjointSets<std::size_t> sets(system.edges.size());
    for (const IntervalRule& rule : system.rules) {
        for (const auto& [edge, coefficient] : rule.terms) {
            sets.unite(edge, rule.terms[0].first);
        }
    }
    std::vector<std::vector<std::size_t>> by_root(system.edges.size() + 1);
    for (std::size_t i = 0; i < system.rules.size(); ++i) {
        const auto& terms = system.rules[i].terms;
        by_root[terms.empty() ? system.edges.size() : sets.root(terms[0].first)].push_back(i);
    }
    std::erase_if(by_root, [](const auto& rules) { return rules.empty(); });
    return by_root;
}

PAVIOR_INLINE SystemPart system_part(const IntervalSystem& whole, const std::vector<std::size_t>& rules) {
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

}  // namespace pavior
