#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>
#include <pavior/sweep/harmonic_error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE HarmonicError::HarmonicError(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                           std::span<const Index> loop)
    : loop_size_(static_cast<Eigen::Index>(loop.size())), unknown_(nodes.size(), unused) {
    if (const auto lost = detail::unreached_node(nodes.size(), quads, loop)) {
        throw InputError(ErrorCode::non_manifold, "no quads connect node " + std::to_string(*lost) + " to the loops",
                         {*lost});
    }
    for (const QuadCorners& quad : quads) {
        for (const Index i : quad) {
            unknown_[i] = pending;
        }
    }
    for (std::size_t j = 0; j < loop.size(); ++j) {
        unknown_[loop[j]] = -1 - static_cast<Eigen::Index>(j);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (unknown_[i] == pending) {
            unknown_[i] = static_cast<Eigen::Index>(inner_.size());
            inner_.push_back(static_cast<Index>(i));
        }
    }
    assemble(nodes, quads);
}

PAVIOR_INLINE HarmonicError::Prepared HarmonicError::prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals,
                                                             Execution execution) const {
    Prepared prepared{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknown_.size()), residuals.cols())};
    // Column by column, so that none depends on its neighbours.
    parallel_for(execution, static_cast<std::size_t>(residuals.cols()), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end && !inner_.empty(); ++c) {
            const auto column = static_cast<Eigen::Index>(c);
            const Eigen::VectorXd right = coupling_ * residuals.col(column);
            const Eigen::VectorXd solution = factor_->solve(right);
            for (std::size_t i = 0; i < inner_.size(); ++i) {
                prepared.field(inner_[i], column) = solution[static_cast<Eigen::Index>(i)];
            }
        }
    });
    return prepared;
}

PAVIOR_INLINE void HarmonicError::add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out,
                                      std::size_t stride) const {
    for (Eigen::Index c = 0; c < prepared.field.cols(); ++c) {
        const double* column = prepared.field.col(c).data();
        double* to = out + static_cast<std::size_t>(c) * stride;
        for (std::size_t i = begin; i < end; ++i) {
            to[i - begin] += column[i];
        }
    }
}

PAVIOR_INLINE void HarmonicError::assemble(std::span<const Vec3> nodes, std::span<const QuadCorners> quads) {
    std::vector<Triplet> laplacian;
    std::vector<Triplet> coupling;
    for (const QuadCorners& quad : quads) {
        const Vec3 centre = (nodes[quad[0]] / 4 + nodes[quad[1]] / 4) + (nodes[quad[2]] / 4 + nodes[quad[3]] / 4);
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = quad[k];
            const Index b = quad[(k + 1) % 4];
            const double weight = edge_weight(nodes[a], nodes[b], centre);
            add_half(a, b, weight, laplacian, coupling);
            add_half(b, a, weight, laplacian, coupling);
        }
    }
    const auto n = static_cast<Eigen::Index>(inner_.size());
    Matrix matrix(n, n);
    matrix.setFromTriplets(laplacian.begin(), laplacian.end());
    coupling_.resize(n, loop_size_);
    coupling_.setFromTriplets(coupling.begin(), coupling.end());
    factor_ = std::make_shared<Eigen::SimplicialLDLT<Matrix>>(matrix);
    PAVIOR_ASSERT(n == 0 || factor_->info() == Eigen::Success);
}

PAVIOR_INLINE double HarmonicError::edge_weight(const Vec3& a, const Vec3& b, const Vec3& centre) {
    const double length = (b - a).stableNorm();
    const double across = ((a / 2 + b / 2) - centre).stableNorm();
    const double least = 1e-12;
    const double ratio = across / length;
    return length > 0 ? std::clamp(ratio, least, 1 / least) : 1 / least;
}

PAVIOR_INLINE void HarmonicError::add_half(Index a, Index b, double weight, std::vector<Triplet>& laplacian,
                                           std::vector<Triplet>& coupling) const {
    const Eigen::Index row = unknown_[a];
    if (row < 0) {
        return;
    }
    laplacian.emplace_back(row, row, weight);
    if (unknown_[b] < 0) {
        coupling.emplace_back(row, -1 - unknown_[b], weight);
    } else if (row > unknown_[b]) {
        laplacian.emplace_back(row, unknown_[b], -weight);
    }
}

}  // namespace pavior
