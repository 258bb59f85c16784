#pragma once
/// \file
/// The unknowns of submapping: lattice coordinates of vertices as sums of numbers of intervals, and as lengths.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace pavior {

namespace detail {

/// A sum of numbers of intervals: position in IntervalSystem::edges and coefficient.
using IntervalSum = std::map<std::size_t, int>;

[[nodiscard]] PAVIOR_INLINE IntervalSum difference(IntervalSum a, const IntervalSum& b);

/// Tells whether homogeneous equations follow from those before; arithmetic modulo a large prime.
class EquationSpan {
public:
    /// Takes the equation sum = 0 in. False if those taken in before imply it.
    bool add(const IntervalSum& sum);

private:
    static constexpr std::int64_t prime = 2147483647;
    [[nodiscard]] static std::int64_t residue(std::int64_t x) { return ((x % prime) + prime) % prime; }
    [[nodiscard]] static std::int64_t power(std::int64_t x, std::int64_t n);

    std::map<std::size_t, std::map<std::size_t, std::int64_t>> pivots_;
};

/// One step between two vertices of a solid along a logical axis: x(to) - x(from) = sign * n(edge), sign 0 across.
struct LatticeStep {
    std::size_t from = 0, to = 0;
    int sign = 0;
    std::size_t edge = 0;
    double length = 0.0;  ///< in space, with its sign
};

/// The value of a sum for given numbers of intervals.
[[nodiscard]] PAVIOR_INLINE int value(const IntervalSum& sum, const std::vector<int>& numbers);

/// The lattice coordinates of a solid's vertices as sums of numbers of intervals, and as lengths.
class SolidUnknowns {
public:
    std::map<VertexId, std::size_t> index;               ///< of the vertices
    std::array<std::vector<LatticeStep>, 3> steps;       ///< per axis
    std::array<std::vector<IntervalSum>, 3> coordinate;  ///< per axis and vertex
    std::array<std::vector<double>, 3> length;           ///< per axis and vertex: the coordinate wished for, in space
    std::array<std::vector<std::size_t>, 3> closing;     ///< steps that close a cycle

    std::size_t vertex(VertexId v) { return index.try_emplace(v, index.size()).first->second; }

    /// Coordinates along spanning trees, and lengths by least squares over all steps.
    void resolve();

private:
    void span_tree(std::size_t a);

    void fit_lengths(std::size_t a);
};

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_unknowns-inl.hpp>
#endif
