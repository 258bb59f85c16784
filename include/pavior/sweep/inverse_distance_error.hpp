#pragma once
/// \file
/// Boundary error by inverse squared distances; Blacker's procedure as Section 4.3.1 \cite roca2009 uses it.

#include <pavior/affine/centring.hpp>
#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>
#include <pavior/sweep/node_kernel.hpp>

#include <Eigen/Core>

#include <algorithm>
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

    InverseDistanceError(std::span<const Vec3> nodes, std::span<const Index> loop) {
        // The centre comes from the loops, whose order does not depend on the numbering of the nodes.
        Eigen::Matrix<double, 3, Eigen::Dynamic> points(3, static_cast<Eigen::Index>(loop.size()));
        for (std::size_t i = 0; i < loop.size(); ++i) {
            points.col(static_cast<Eigen::Index>(i)) = nodes[loop[i]];
        }
        const auto local = centring(points);
        scale_ = local.scale;
        const std::size_t padded = (nodes.size() + detail::weight_tile - 1) / detail::weight_tile * detail::weight_tile;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto axis = static_cast<Eigen::Index>(c);
            node_[c].assign(padded, 0.0);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                node_[c][i] = (nodes[i][axis] - local.centre[axis]) / scale_;
            }
            for (const Index i : loop) {
                loop_[c].push_back(node_[c][i]);
            }
        }
    }

    [[nodiscard]] std::size_t loop_size() const { return loop_[0].size(); }

    /// The m weights at node i, normalised. O(m).
    [[nodiscard]] std::vector<double> weights(std::size_t i) const {
        std::vector<double> tile(loop_size() * detail::weight_tile);
        std::array<double, detail::weight_tile> sums{};
        const std::size_t first = i / detail::weight_tile * detail::weight_tile;
        make_tile(first, tile.data(), sums.data(), best_instruction_set());
        std::vector<double> result(loop_size());
        for (std::size_t k = 0; k < result.size(); ++k) {
            result[k] = tile[k * detail::weight_tile + (i - first)] / sums[i - first];
        }
        return result;
    }

    [[nodiscard]] Prepared prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals) const {
        constexpr std::size_t width = detail::strip_columns;
        Prepared prepared;
        prepared.columns = static_cast<std::size_t>(residuals.cols());
        const std::size_t m = loop_size();
        prepared.strips.assign((prepared.columns + width - 1) / width * width * m, 0.0);
        for (std::size_t c = 0; c < prepared.columns; ++c) {
            double* strip = prepared.strips.data() + c / width * width * m + c % width;
            for (std::size_t i = 0; i < m; ++i) {
                strip[i * width] = residuals(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) / scale_;
            }
        }
        return prepared;
    }

    /// See BoundaryError::add(). \p instructions does not change the result.
    void add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out, std::size_t stride,
             InstructionSet instructions = best_instruction_set()) const {
        constexpr std::size_t width = detail::strip_columns;
        constexpr std::size_t tile_size = detail::weight_tile;
        const std::size_t m = loop_size();
        std::vector<double> tile(m * tile_size);
        std::array<double, tile_size> sums{};
        std::array<double, width * tile_size> field{};
        for (std::size_t i = begin; i < end; i += tile_size) {
            make_tile(i, tile.data(), sums.data(), instructions);
            for (double& sum : sums) {
                sum /= scale_;
            }
            for (std::size_t first = 0; first < prepared.columns; first += width) {
                field.fill(0.0);
                detail::weighted_residuals(instructions, tile.data(), sums.data(), prepared.strips.data() + first * m,
                                           m, field.data(), tile_size);
                for (std::size_t c = 0; c < std::min(width, prepared.columns - first); ++c) {
                    for (std::size_t j = 0; j < tile_size; ++j) {
                        out[(first + c) * stride + (i - begin) + j] += field[c * tile_size + j];
                    }
                }
            }
        }
    }

private:
    void make_tile(std::size_t first, double* tile, double* sums, InstructionSet instructions) const {
        const std::array<const double*, 3> at{node_[0].data() + first, node_[1].data() + first,
                                              node_[2].data() + first};
        const std::array<const double*, 3> loop{loop_[0].data(), loop_[1].data(), loop_[2].data()};
        detail::inverse_square_weights(instructions, at.data(), loop.data(), loop_size(), tile, sums);
    }

    double scale_ = 1;                         ///< power of two near the size of the cap
    std::array<std::vector<double>, 3> node_;  ///< centred, divided by scale_
    std::array<std::vector<double>, 3> loop_;
};

}  // namespace pavior
