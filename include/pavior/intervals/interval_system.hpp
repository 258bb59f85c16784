#pragma once
/// \file
/// Numbers of intervals on edges: wishes, and the rules that tie them together.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// An edge that is to be divided.
struct IntervalEdge {
    double wish = 1.0;  ///< intervals wished for, a positive number
    int lower = 1;      ///< at least this many
};

/// A condition on the numbers of intervals n: with s = sum coefficient * n,
/// equal: s = value; even: s is even; at_least: s >= value.
struct IntervalRule {
    enum class Kind : std::uint8_t { equal, even, at_least };
    Kind kind = Kind::equal;
    std::vector<std::pair<std::size_t, int>> terms;  ///< index in IntervalSystem::edges, each once, and coefficient
    int value = 0;
    std::string text;        ///< says in the user's tags what the rule demands
    std::vector<int> faces;  ///< tags of the faces concerned
};

/// Edges with their wishes, and the rules that tie them together.
struct IntervalSystem {
    std::vector<IntervalEdge> edges;
    std::vector<IntervalRule> rules;
};

/// What a number of intervals costs: max(n / wish, wish / n) - 1, the relative deviation, convex in n.
[[nodiscard]] inline double interval_cost(int n, double wish) { return std::max(n / wish, wish / n) - 1.0; }

}  // namespace pavior
