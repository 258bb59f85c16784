#pragma once
/// \file
/// A barrier on the scaled Jacobians of a patch: what raises the smallest of them.

#include <pavior/core/execution.hpp>
#include <pavior/smooth/detail/cell_sum.hpp>
#include <pavior/smooth/distortion.hpp>
#include <pavior/smooth/lbfgs.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Scaled determinants q below \p floor are forbidden; those that exceed it by \p margin cost 1.
struct BarrierMode {
    double floor = 0.0;
    double margin = 0.1;
};

/// Sum of (margin / (q - floor))^2 over the scaled determinants q of the simplices of CellSum<3>. They know angles
/// only; so that sizes do not drift, a little of s + 1/s is added for the squared length s of every edge at a corner
/// relative to the mean of the four edges of its direction in its cell, as they were at first.
class ScaledBarrier : public CellSum<3> {
public:
    ScaledBarrier(Eigen::Matrix3Xd points, std::vector<HexCorners> cells, std::size_t free_count, int samples,
                  Execution execution)
        : CellSum<3>(std::move(points), std::move(cells), free_count, samples, execution), parts_(part_count()) {
        find_sizes();
    }

    /// Value at x, infinite unless every q is above the floor, and its gradient.
    double evaluate(const Eigen::VectorXd& x, const BarrierMode& mode, Eigen::VectorXd& gradient) {
        sum(x, parts_, gradient, [&](double& part, std::size_t cell, int simplex, const Matrix& edges, Matrix& slope) {
            const double room = scaled_slope(edges, slope) - mode.floor;
            if (!(room > 0.0)) {
                part = std::numeric_limits<double>::infinity();
                return false;
            }
            const double ratio = mode.margin / room;
            part += ratio * ratio;
            slope *= -2.0 * ratio * ratio / room;
            for (int k = 0; k < 3 && simplex < corners; ++k) {
                const double unit = inverse_size(cell, simplex, k);
                const double size = edges.col(k).squaredNorm() * unit;
                part += size_weight * (size + 1.0 / (size + shortest));
                slope.col(k) +=
                    (2.0 * size_weight * unit * (1.0 - 1.0 / ((size + shortest) * (size + shortest)))) * edges.col(k);
            }
            return true;
        });
        double total = 0.0;
        for (const double part : parts_) {
            total += part;
        }
        return total;
    }

    /// Positive estimate of the diagonal of the Hessian at x, where the value is finite.
    void diagonal(const Eigen::VectorXd& x, const BarrierMode& mode, Eigen::VectorXd& result) {
        sum_diagonal(x, result, [&](std::size_t cell, int simplex, const Matrix& edges) {
            Matrix slope;
            const double room = scaled_slope(edges, slope) - mode.floor;
            const double ratio = mode.margin / room;
            const CellPoints<3> rows = edge_rows(simplex, Matrix::Identity());
            const Eigen::Vector3d squares = edges.colwise().squaredNorm().cwiseMax(1e-300);
            const double by_scaled = 2.0 * ratio * ratio / (room * room);
            Eigen::Vector3d by_edges = by_scaled * room / 3.0 * squares.cwiseInverse();
            for (int k = 0; k < 3 && simplex < corners; ++k) {
                by_edges[k] += 4.0 * size_weight * inverse_size(cell, simplex, k);
            }
            return (by_scaled * (slope * rows).colwise().squaredNorm() + by_edges.transpose() * rows.cwiseAbs2())
                .transpose()
                .eval();
        });
    }

    /// Smallest scaled determinant over the simplices that depend on a free node; 1 if there is none.
    [[nodiscard]] double quality(const Eigen::VectorXd& x) {
        return least(x, [](std::size_t, int, const Matrix& edges) { return scaled_determinant<3>(edges); });
    }

private:
    /// The scaled determinant of \p edges and its derivative by them.
    static double scaled_slope(const Matrix& edges, Matrix& slope) {
        const Eigen::Vector3d squares = edges.colwise().squaredNorm();
        const double lengths = std::sqrt(squares[0] * squares[1] * squares[2]);
        if (!(lengths > 0.0)) {
            slope.setZero();
            return 0.0;
        }
        const Matrix cofactor = cofactors<3>(edges);
        const double scaled = edges.col(0).dot(cofactor.col(0)) / lengths;
        slope = cofactor / lengths - edges * (scaled * squares.cwiseInverse()).asDiagonal();
        return scaled;
    }

    static constexpr double size_weight = 0.01;
    static constexpr double shortest = 0.01;  ///< keeps the cost of edges without length finite

    /// Direction of edge k at a corner: 0 along 01, 1 along 03, 2 along 04.
    [[nodiscard]] static Eigen::Index axis(int corner, int k) {
        const int other = hex_corner_neighbours[at(corner)][at(k)];
        return corner / 4 != other / 4 ? 2 : corner % 4 + other % 4 == 1 || corner % 4 + other % 4 == 5 ? 0 : 1;
    }
    /// One over the mean square length in that direction; 0 if that is 0.
    [[nodiscard]] double inverse_size(std::size_t cell, int corner, int k) const {
        return inverse_sizes_(axis(corner, k), static_cast<Eigen::Index>(cell));
    }

    void find_sizes() {
        inverse_sizes_.resize(3, static_cast<Eigen::Index>(cell_count()));
        for (std::size_t cell = 0; cell < cell_count(); ++cell) {
            const CellPoints<3> points = gather_points(cell);
            Eigen::Vector3d squares = Eigen::Vector3d::Zero();
            for (int corner = 0; corner < corners; ++corner) {
                const Matrix edges = corner_edges<3>(points, corner);
                for (int k = 0; k < 3; ++k) {
                    squares[axis(corner, k)] += edges.col(k).squaredNorm() / 8.0;
                }
            }
            for (Eigen::Index k = 0; k < 3; ++k) {
                inverse_sizes_(k, static_cast<Eigen::Index>(cell)) = squares[k] > 0.0 ? 1.0 / squares[k] : 0.0;
            }
        }
    }

    Eigen::Matrix3Xd inverse_sizes_;
    std::vector<double> parts_;
};

/// Moves x so that the smallest scaled determinant grows: minimises the barrier, puts its floor below the new minimum,
/// and so on while that pays. Energy: as ScaledBarrier, with settle(x).
/// \param wanted  end as soon as the minimum reaches this.
/// \return the minimum and what L-BFGS did.
template <class Energy>
LbfgsResult raise_scaled(Energy& energy, Eigen::VectorXd& x, double wanted, Lbfgs& lbfgs) {
    Eigen::VectorXd diagonal(x.size());
    Eigen::VectorXd best = x;
    energy.settle(x);
    double now = energy.quality(x);
    double highest = now;
    LbfgsResult total;
    for (int round = 0; round < 8 && now < wanted; ++round) {
        const double margin = 0.1 * (1.0 - now);
        const BarrierMode mode{now - margin, margin};
        energy.diagonal(x, mode, diagonal);
        const auto value = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
            return energy.evaluate(at, mode, gradient);
        };
        const LbfgsResult done = lbfgs.minimise(x, value, {60, 1e-3, 1e-10}, diagonal);
        total.iterations += done.iterations;
        total.evaluations += done.evaluations;
        energy.settle(x);
        const double fresh = energy.quality(x);
        if (fresh > highest) {
            highest = fresh;
            best = x;
        }
        if (!(fresh > now + 0.2 * margin)) {
            break;
        }
        now = fresh;
    }
    if (highest > now) {
        x = best;
    }
    total.value = highest;
    return total;
}

}  // namespace pavior::detail
