#pragma once

#include <pavior/core/error.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>
#include <pavior/sweep/harmonic_error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE HarmonicError::HarmonicError(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                           std::span<const Index> loop)
    : size_(nodes.size()) {
    if (const auto lost = detail::unreached_node(nodes.size(), quads, loop)) {
        throw InputError(ErrorCode::non_manifold, "no quads connect node " + std::to_string(*lost) + " to the loops",
                         {*lost});
    }
    constexpr std::int64_t pending = std::numeric_limits<std::int64_t>::max();
    std::vector<std::int64_t> number(nodes.size(), -1);
    for (const QuadCorners& quad : quads) {
        for (const Index i : quad) {
            number[i] = pending;
        }
    }
    for (std::size_t j = 0; j < loop.size(); ++j) {
        number[loop[j]] = -1 - static_cast<std::int64_t>(j);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (number[i] == pending) {
            number[i] = static_cast<std::int64_t>(inner_.size());
            inner_.push_back(static_cast<Index>(i));
        }
    }
    std::vector<GraphLaplacian::Edge> edges;
    for (const QuadCorners& quad : quads) {
        const Vec3 centre = (nodes[quad[0]] / 4 + nodes[quad[1]] / 4) + (nodes[quad[2]] / 4 + nodes[quad[3]] / 4);
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = quad[k];
            const Index b = quad[(k + 1) % 4];
            edges.push_back({number[a], number[b], edge_weight(nodes[a], nodes[b], centre)});
        }
    }
    laplacian_ =
        GraphLaplacian(static_cast<std::int64_t>(inner_.size()), static_cast<std::int64_t>(loop.size()), edges);
}

PAVIOR_INLINE HarmonicError::Prepared HarmonicError::prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals,
                                                             Execution execution) const {
    Prepared prepared{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size_), residuals.cols())};
    // Column by column, so that none depends on its neighbours.
    parallel_for(execution, static_cast<std::size_t>(residuals.cols()), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end && !inner_.empty(); ++c) {
            const auto column = static_cast<Eigen::Index>(c);
            const Eigen::VectorXd solution = laplacian_.solve(residuals.col(column));
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

PAVIOR_INLINE double HarmonicError::edge_weight(const Vec3& a, const Vec3& b, const Vec3& centre) {
    const double length = (b - a).stableNorm();
    const double across = ((a / 2 + b / 2) - centre).stableNorm();
    const double least = 1e-12;
    const double ratio = across / length;
    return length > 0 ? std::clamp(ratio, least, 1 / least) : 1 / least;
}

}  // namespace pavior
