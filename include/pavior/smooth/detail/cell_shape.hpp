#pragma once
/// \file
/// Local numbering and shape of quads (d = 2) and hexahedra (d = 3), one spelling for both.

#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/options.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace pavior::detail {

/// Corners of the cells of dimension D and the neighbours of each: the simplex (corner, neighbours in order) of a
/// well-shaped cell is positive.
template <int D>
struct CellTopology;

template <>
struct CellTopology<2> {
    using Corners = QuadCorners;
    static constexpr int corners = 4;
    static constexpr std::array<std::array<int, 2>, 4> neighbours{{{1, 3}, {2, 0}, {3, 1}, {0, 2}}};
};

template <>
struct CellTopology<3> {
    using Corners = HexCorners;
    static constexpr int corners = 8;
    static constexpr std::array<std::array<int, 3>, 8> neighbours = hex_corner_neighbours;
};

template <int D>
using CellCorners = typename CellTopology<D>::Corners;
/// d x (number of corners) coordinates of a cell.
template <int D>
using CellPoints = Eigen::Matrix<double, D, CellTopology<D>::corners>;

/// Derivatives of the eight trilinear shape functions at a point of [0, 1]^3.
using HexGradient = std::array<std::array<double, 3>, 8>;

constexpr HexGradient hex_gradient(double u, double v, double w) {
    HexGradient gradient{};
    for (std::size_t k = 0; k < 8; ++k) {
        const bool right = k % 4 == 1 || k % 4 == 2;
        const double a = right ? u : 1.0 - u;
        const double b = k % 4 >= 2 ? v : 1.0 - v;
        const double c = k >= 4 ? w : 1.0 - w;
        gradient[k] = {(right ? 1.0 : -1.0) * b * c, (k % 4 >= 2 ? 1.0 : -1.0) * a * c, (k >= 4 ? 1.0 : -1.0) * a * b};
    }
    return gradient;
}

constexpr std::array<HexGradient, 19> make_hex_samples() {
    std::array<HexGradient, 19> samples{};
    std::size_t next = 0;
    samples[next++] = hex_gradient(0.5, 0.5, 0.5);
    for (int code = 0; code < 27; ++code) {
        const std::array<int, 3> at{code % 3, code / 3 % 3, code / 9};
        const int middles = (at[0] == 1 ? 1 : 0) + (at[1] == 1 ? 1 : 0) + (at[2] == 1 ? 1 : 0);
        if (middles == 1 || middles == 2) {
            samples[next++] = hex_gradient(0.5 * at[0], 0.5 * at[1], 0.5 * at[2]);
        }
    }
    return samples;
}

/// Points of a hexahedron besides its corners: the centre first, then the middles of edges and faces.
inline constexpr std::array<HexGradient, 19> hex_samples = make_hex_samples();

/// Number of samples of hex_samples that \p positivity asks for; none for quads.
template <int D>
[[nodiscard]] constexpr int sample_count(HexPositivity positivity) {
    return D == 2 ? 0 : (positivity == HexPositivity::sampled ? 19 : 1);
}

/// d x d matrix of the edges that leave a corner.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> corner_edges(const CellPoints<D>& points, int corner) {
    Eigen::Matrix<double, D, D> edges;
    for (int k = 0; k < D; ++k) {
        const int other = CellTopology<D>::neighbours[static_cast<std::size_t>(corner)][static_cast<std::size_t>(k)];
        edges.col(k) = points.col(other) - points.col(corner);
    }
    return edges;
}

/// 3 x 3 Jacobian of the trilinear map at a sample.
[[nodiscard]] inline Eigen::Matrix3d sample_jacobian(const CellPoints<3>& points, const HexGradient& gradient) {
    return points * Eigen::Map<const Eigen::Matrix<double, 3, 8>>(gradient[0].data()).transpose();
}

/// Jacobian of simplex k of a cell: its corners first, then its samples.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> simplex_edges(const CellPoints<D>& points, int simplex) {
    if constexpr (D == 3) {
        if (simplex >= 8) {
            return sample_jacobian(points, hex_samples[static_cast<std::size_t>(simplex - 8)]);
        }
    }
    return corner_edges<D>(points, simplex);
}

/// Power of two next to the extent of the nodes: edges divided by it neither overflow nor underflow.
template <int D>
[[nodiscard]] double unit_of(std::span<const Eigen::Matrix<double, D, 1>> nodes) {
    double extent = 0.0;
    for (const auto& x : nodes) {
        extent = std::max(extent, (x - nodes[0]).cwiseAbs().maxCoeff());
    }
    return extent > 0.0 ? std::exp2(std::floor(std::log2(extent))) : 1.0;
}

/// Corners of a cell relative to the first, divided by \p unit.
template <int D>
[[nodiscard]] CellPoints<D> cell_points(std::span<const Eigen::Matrix<double, D, 1>> nodes,
                                        const CellCorners<D>& corners, double unit) {
    CellPoints<D> result;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        result.col(static_cast<Eigen::Index>(k)) = (nodes[corners[k]] - nodes[corners[0]]) / unit;
    }
    return result;
}

/// Determinant of the columns scaled to unit length; 0 if one is null.
template <int D>
[[nodiscard]] double scaled_determinant(const Eigen::Matrix<double, D, D>& columns) {
    double lengths = 1.0;
    for (int k = 0; k < D; ++k) {
        lengths *= columns.col(k).norm();
    }
    if (!(lengths > 0.0)) {
        return 0.0;
    }
    double det = 0.0;
    if constexpr (D == 2) {
        det = columns(0, 0) * columns(1, 1) - columns(0, 1) * columns(1, 0);
    } else {
        det = columns.col(0).dot(columns.col(1).cross(columns.col(2)));
    }
    return det / lengths;
}

/// Smallest scaled determinant over the corners and the first \p samples samples: the scaled Jacobian of the cell.
template <int D>
[[nodiscard]] double scaled_jacobian(const CellPoints<D>& points, int samples) {
    double least = 1.0;
    for (int corner = 0; corner < CellTopology<D>::corners; ++corner) {
        least = std::min(least, scaled_determinant<D>(corner_edges<D>(points, corner)));
    }
    if constexpr (D == 3) {
        for (int s = 0; s < samples; ++s) {
            least = std::min(least,
                             scaled_determinant<3>(sample_jacobian(points, hex_samples[static_cast<std::size_t>(s)])));
        }
    }
    return least;
}

/// Signed area of a quad; volume of a trilinear hexahedron.
template <int D>
[[nodiscard]] double signed_measure(const CellPoints<D>& points) {
    double sum = 0.0;
    for (int corner = 0; corner < CellTopology<D>::corners; ++corner) {
        sum += corner_edges<D>(points, corner).determinant();
    }
    if constexpr (D == 2) {
        return 0.25 * sum;
    } else {
        const auto inner = [&](int a, int b, int c, int d) {
            Eigen::Matrix3d edges;
            edges << points.col(b) - points.col(a), points.col(c) - points.col(a), points.col(d) - points.col(a);
            return edges.determinant();
        };
        return (sum + inner(0, 2, 7, 5) + inner(1, 3, 4, 6)) / 12.0;
    }
}

}  // namespace pavior::detail
