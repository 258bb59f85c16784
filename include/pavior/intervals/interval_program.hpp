#pragma once
/// \file
/// An interval system as an integer program.

#include <pavior/core/compiled.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/intervals/interval_system.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

/// Edges that rules of the form n_a = n_b make equal: the class of each edge.
class EqualEdges {
public:
    EqualEdges(const IntervalSystem& system, const std::vector<std::size_t>& active);

    /// The lowest edge of the class.
    [[nodiscard]] std::size_t operator[](std::size_t edge) const { return class_[edge]; }

private:
    std::vector<std::size_t> class_;
};

/// The integer program of a system, restricted to the rules in `active`.
class IntervalProgram {
public:
    IntervalProgram(const IntervalSystem& system, const std::vector<std::size_t>& active, bool with_cost);

    [[nodiscard]] const IntegerProgram& program() const { return program_; }

    [[nodiscard]] std::vector<int> numbers(const IntegerSolution& solution) const;

private:
    void add_classes(bool with_cost);

    /// n = lower + sum of one bounded piece per segment of the convex cost; each piece costs the slope of its segment.
    void add_cost(std::size_t n, int lower, const std::vector<double>& wishes);

    void add_rule(const IntervalRule& rule);

    const IntervalSystem& system_;
    EqualEdges classes_;
    std::vector<std::size_t> variable_;
    IntegerProgram program_;
};

/// Numbers at which the cost of a class of edges is exact; linear in between, and beyond the last.
[[nodiscard]] PAVIOR_INLINE std::vector<int> cost_breakpoints(int lower, const std::vector<double>& wishes);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/intervals/interval_program-inl.hpp>
#endif
