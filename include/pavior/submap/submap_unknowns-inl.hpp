#pragma once

#include <pavior/lattice/submap_lattice.hpp>
#include <pavior/submap/submap_unknowns.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE IntervalSum difference(IntervalSum a, const IntervalSum& b) {
    for (const auto& [edge, coefficient] : b) {
        if ((a[edge] -= coefficient) == 0) {
            a.erase(edge);
        }
    }
    return a;
}

PAVIOR_INLINE bool EquationSpan::add(const IntervalSum& sum) {
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

PAVIOR_INLINE std::int64_t EquationSpan::power(std::int64_t x, std::int64_t n) {
    std::int64_t result = 1;
    for (; n > 0; n /= 2, x = x * x % prime) {
        result = n % 2 != 0 ? result * x % prime : result;
    }
    return result;
}

PAVIOR_INLINE int value(const IntervalSum& sum, const std::vector<int>& numbers) {
    int result = 0;
    for (const auto& [edge, coefficient] : sum) {
        result += coefficient * numbers[edge];
    }
    return result;
}

PAVIOR_INLINE void SolidUnknowns::resolve() {
    for (std::size_t a = 0; a < 3; ++a) {
        span_tree(a);
        fit_lengths(a);
    }
}

PAVIOR_INLINE void SolidUnknowns::span_tree(std::size_t a) {
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

PAVIOR_INLINE void SolidUnknowns::fit_lengths(std::size_t a) {
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

}  // namespace detail

}  // namespace pavior
