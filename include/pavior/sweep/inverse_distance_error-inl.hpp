#pragma once

#include <pavior/affine/centring.hpp>
#include <pavior/sweep/inverse_distance_error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE InverseDistanceError::InverseDistanceError(std::span<const Vec3> nodes, std::span<const Index> loop) {
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

PAVIOR_INLINE std::vector<double> InverseDistanceError::weights(std::size_t i) const {
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

PAVIOR_INLINE InverseDistanceError::Prepared InverseDistanceError::prepare(
    const Eigen::Ref<const Eigen::MatrixXd>& residuals) const {
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

PAVIOR_INLINE void InverseDistanceError::add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out,
                                             std::size_t stride, InstructionSet instructions) const {
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
            detail::weighted_residuals(instructions, tile.data(), sums.data(), prepared.strips.data() + first * m, m,
                                       field.data(), tile_size);
            for (std::size_t c = 0; c < std::min(width, prepared.columns - first); ++c) {
                for (std::size_t j = 0; j < tile_size; ++j) {
                    out[(first + c) * stride + (i - begin) + j] += field[c * tile_size + j];
                }
            }
        }
    }
}

PAVIOR_INLINE void InverseDistanceError::make_tile(std::size_t first, double* tile, double* sums,
                                                   InstructionSet instructions) const {
    const std::array<const double*, 3> at{node_[0].data() + first, node_[1].data() + first, node_[2].data() + first};
    const std::array<const double*, 3> loop{loop_[0].data(), loop_[1].data(), loop_[2].data()};
    detail::inverse_square_weights(instructions, at.data(), loop.data(), loop_size(), tile, sums);
}

}  // namespace pavior
