#pragma once
/// \file
/// The unknowns of submapping: lattice coordinates of vertices as sums of numbers of intervals, and as lengths.

#include <pavior/lattice/submap_lattice.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// A sum of numbers of intervals: position in IntervalSystem::edges and coefficient.
using IntervalSum = std::map<std::size_t, int>;

[[nodiscard]] inline IntervalSum difference(IntervalSum a, const IntervalSum& b) {
    for (const auto& [edge, coefficient] : b) {
        if ((a[edge] -= coefficient) == 0) {
            a.erase(edge);
        }
    }
    return a;
}

/// Tells whether homogeneous equations follow from those before; arithmetic modulo a large prime.
class EquationSpan {
public:
    /// Takes the equation sum = 0 in. False if those taken in before imply it.
    bool add(const IntervalSum& sum) {
        std::map<std::size_t, std::int64_t> row;
        for (const auto& [edge, coefficient] : sum) {
            row[edge] = residue(coefficient);
        }
        while (!row.empty()) {
            const auto [column, value] = *row.begin();
            const auto pivot = pivots_.find(column);
            if (pivot == pivots_.end()) {
                const std::int64_t factor = power(value, prime - 2);
                for (auto& [edge, coefficient] : row) {
                    coefficient = coefficient * factor % prime;
                }
                pivots_.emplace(column, std::move(row));
                return true;
            }
            for (const auto& [edge, coefficient] : pivot->second) {
                std::int64_t& at = row[edge];
                at = residue(at - value * coefficient % prime);
                if (at == 0) {
                    row.erase(edge);
                }
            }
        }
        return false;
    }

private:
    static constexpr std::int64_t prime = 2147483647;
    [[nodiscard]] static std::int64_t residue(std::int64_t x) { return ((x % prime) + prime) % prime; }
    [[nodiscard]] static std::int64_t power(std::int64_t x, std::int64_t n) {
        std::int64_t result = 1;
        for (; n > 0; n /= 2, x = x * x % prime) {
            result = n % 2 != 0 ? result * x % prime : result;
        }
        return result;
    }

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
[[nodiscard]] inline int value(const IntervalSum& sum, const std::vector<int>& numbers) {
    int result = 0;
    for (const auto& [edge, coefficient] : sum) {
        result += coefficient * numbers[edge];
    }
    return result;
}

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
    void resolve() {
        for (std::size_t a = 0; a < 3; ++a) {
            span_tree(a);
            fit_lengths(a);
        }
    }

private:
    void span_tree(std::size_t a) {
        coordinate[a].assign(index.size(), {});
        std::vector<std::vector<std::size_t>> at(index.size());
        for (std::size_t i = 0; i < steps[a].size(); ++i) {
            at[steps[a][i].from].push_back(i);
            at[steps[a][i].to].push_back(i);
        }
        std::vector<bool> reached(index.size(), false), used(steps[a].size(), false);
        std::vector<std::size_t> queue{0};
        reached[0] = true;
        for (std::size_t q = 0; q < queue.size(); ++q) {
            for (const std::size_t i : at[queue[q]]) {
                const LatticeStep& step = steps[a][i];
                const bool forward = step.from == queue[q];
                const std::size_t next = forward ? step.to : step.from;
                if (reached[next]) {
                    continue;
                }
                used[i] = reached[next] = true;
                queue.push_back(next);
                coordinate[a][next] = coordinate[a][queue[q]];
                if (step.sign != 0) {
                    int& coefficient = coordinate[a][next][step.edge];
                    coefficient += forward ? step.sign : -step.sign;
                    if (coefficient == 0) {
                        coordinate[a][next].erase(step.edge);
                    }
                }
            }
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (!used[i]) {
                closing[a].push_back(i);
            }
        }
    }

    void fit_lengths(std::size_t a) {
        const auto n = static_cast<Eigen::Index>(index.size());
        std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}};
        Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
        for (const LatticeStep& step : steps[a]) {
            const auto from = static_cast<int>(step.from), to = static_cast<int>(step.to);
            entries.insert(entries.end(), {{from, from, 1.0}, {to, to, 1.0}, {from, to, -1.0}, {to, from, -1.0}});
            right[to] += step.length;
            right[from] -= step.length;
        }
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
        const Eigen::VectorXd x = factor.solve(right);
        length[a].assign(x.data(), x.data() + n);
    }
};

}  // namespace detail

}  // namespace pavior
