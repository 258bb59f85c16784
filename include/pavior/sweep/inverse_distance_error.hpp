#pragma once
/// \file
/// Boundary error by inverse squared distances; Blacker's procedure as Section 4.3.1 \cite roca2009 uses it.

#include <pavior/core/compiled.hpp>
#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>
#include <pavior/sweep/node_kernel.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// e(z) = sum_i w_i(z) e_i with w_i(z) = |z - x_i|^-2 / sum_j |z - x_j|^-2, x_i the loop nodes of all loops, straight
/// distances on the cap. Weights are positive and sum to 1; a node in the place of a loop node takes its residual
/// (the mean, if there are several).
///
/// The m x n weights are never stored: tiles of 16 nodes x m weights are made on the fly and multiplied by strips of 12
/// residual columns while they are in cache. Memory O(n + m c), 10 m n + 2 m n c flops for c columns, three of them for
/// each level (1e5 nodes, 2000 loop nodes, 200 levels: 2.4e11 flops a cap, about 7 s on one core with AVX-512). Exact
/// for each column alone: a low-rank compression over the levels would couple them.
class InverseDistanceError {
public:
    /// Residuals in strips: strip s holds [i * 12 + c] for column 12 s + c, zero beyond the last.
    struct Prepared {
        std::vector<double> strips;
        std::size_t columns = 0;
    };

    InverseDistanceError(std::span<const Vec3> nodes, std::span<const Index> loop);

    [[nodiscard]] std::size_t loop_size() const { return loop_[0].size(); }

    /// The m weights at node i, normalised. O(m).
    [[nodiscard]] std::vector<double> weights(std::size_t i) const;

    [[nodiscard]] Prepared prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals) const;

    /// See BoundaryError::add(). \p instructions does not change the result.
    void add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out, std::size_t stride,
             InstructionSet instructions = best_instruction_set()) const;

private:
    void make_tile(std::size_t first, double* tile, double* sums, InstructionSet instructions) const;

    double scale_ = 1;                         ///< power of two near the size of the cap
    std::array<std::vector<double>, 3> node_;  ///< centred, divided by scale_
    std::array<std::vector<double>, 3> loop_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/inverse_distance_error-inl.hpp>
#endif
