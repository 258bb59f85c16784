#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/math/graph_laplacian.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace pavior {

struct GraphLaplacian::Factor {
    Eigen::SparseMatrix<double> coupling;  ///< unknowns x given
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
};

PAVIOR_INLINE GraphLaplacian::GraphLaplacian(std::int64_t unknowns, std::int64_t given, std::span<const Edge> edges) {
    std::vector<Eigen::Triplet<double>> lower;
    std::vector<Eigen::Triplet<double>> coupling;
    for (const Edge& edge : edges) {
        for (const auto& [row, other] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
            if (row < 0) {
                continue;
            }
            lower.emplace_back(static_cast<int>(row), static_cast<int>(row), edge.weight);
            if (other < 0) {
                coupling.emplace_back(static_cast<int>(row), static_cast<int>(-1 - other), edge.weight);
            } else if (row > other) {
                lower.emplace_back(static_cast<int>(row), static_cast<int>(other), -edge.weight);
            }
        }
    }
    auto factor = std::make_shared<Factor>();
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(lower.begin(), lower.end());
    factor->coupling.resize(unknowns, given);
    factor->coupling.setFromTriplets(coupling.begin(), coupling.end());
    if (unknowns > 0) {
        factor->ldlt.compute(matrix);
        PAVIOR_ASSERT(factor->ldlt.info() == Eigen::Success);
    }
    factor_ = std::move(factor);
}

PAVIOR_INLINE Eigen::VectorXd GraphLaplacian::solve(const Eigen::Ref<const Eigen::VectorXd>& given) const {
    if (!factor_ || factor_->coupling.rows() == 0) {
        return Eigen::VectorXd(0);
    }
    PAVIOR_ASSERT(given.size() == factor_->coupling.cols());
    const Eigen::VectorXd right = factor_->coupling * given;
    return factor_->ldlt.solve(right);
}

}  // namespace pavior
