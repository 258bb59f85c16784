#pragma once
/// \file
/// The regularised distortion summed over the cells of a patch, and its gradient.

#include <pavior/core/execution.hpp>
#include <pavior/smooth/detail/cell_sum.hpp>
#include <pavior/smooth/distortion.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Energy of a patch at one point.
struct EnergyValue {
    double energy = 0.0;  ///< infinity where the barrier is violated
    /// Smallest determinant of the Jacobians from the ideal to the actual simplices.
    double min_det = std::numeric_limits<double>::infinity();
    double max_distortion = 0.0;  ///< largest distortion, >= 1
};

/// How the energy treats bad simplices.
struct EnergyMode {
    double epsilon = 1.0;  ///< regularisation; 0: infinite unless every determinant is positive
    double theta = 0.5;    ///< weight of the volume term
    double ceiling = 0.0;  ///< t >= 0: W / (1 - t W) instead of W, infinite unless t W < 1 everywhere
};

/// Sum of weight * W(J) over the simplices of CellSum; J = metric * edges * to_ideal.
template <int D>
class CellEnergy : public CellSum<D> {
public:
    using Base = CellSum<D>;
    using Base::corners;
    using typename Base::Corners;
    using typename Base::Matrix;

    /// As CellSum.
    CellEnergy(Eigen::Matrix<double, D, Eigen::Dynamic> points, std::vector<Corners> cells, std::size_t free_count,
               int samples, Execution execution)
        : Base(std::move(points), std::move(cells), free_count, samples, execution),
          to_ideal_{Matrix::Identity()},
          weight_{1.0},
          parts_(this->part_count()) {}

    /// Ideal shapes: one inverse edge matrix and weight per simplex, cell by cell, corners first, then samples.
    void set_ideal(std::vector<Matrix> to_ideal, std::vector<double> weight) {
        to_ideal_ = std::move(to_ideal);
        weight_ = std::move(weight);
    }

    /// Square roots of the metric: one matrix per corner, cell by cell (surfaces, D = 2).
    void set_metric(std::vector<Matrix> metric) { metric_ = std::move(metric); }

    /// Energy at x and its gradient, as long as x.
    EnergyValue evaluate(const Eigen::VectorXd& x, const EnergyMode& mode, Eigen::VectorXd& gradient) {
        const auto term = [&](EnergyValue& part, std::size_t cell, int simplex, const Matrix& edges, Matrix& slope) {
            const Matrix J = to_ideal(cell, simplex, jacobian(cell, simplex, edges));
            const Distortion W = distortion<D>(J, mode.epsilon, mode.theta, slope);
            const double room = 1.0 - mode.ceiling * W.value;
            part.min_det = std::min(part.min_det, W.det);
            part.max_distortion = std::max(part.max_distortion, W.value);
            if (!(room > 0.0) || (mode.epsilon == 0.0 && !(W.det > 0.0))) {
                part.energy = std::numeric_limits<double>::infinity();
                return false;
            }
            const double weight = weight_of(cell, simplex);
            part.energy += weight * W.value / room;
            slope *= weight / (room * room);
            if (!cubes()) {
                slope = (slope * ideal_of(cell, simplex).transpose()).eval();
            }
            if (!metric_.empty()) {
                slope = (metric_[metric_at(cell, simplex)].transpose() * slope).eval();
            }
            return true;
        };
        this->sum(x, parts_, gradient, term);
        EnergyValue total;
        for (const EnergyValue& part : parts_) {
            total.energy += part.energy;
            total.min_det = std::min(total.min_det, part.min_det);
            total.max_distortion = std::max(total.max_distortion, part.max_distortion);
        }
        return total;
    }

    /// Smallest scaled determinant over the simplices that depend on a free node; 1 if there is none.
    [[nodiscard]] double quality(const Eigen::VectorXd& x) {
        return this->least(x, [&](std::size_t cell, int simplex, const Matrix& edges) {
            return scaled_determinant<D>(jacobian(cell, simplex, edges));
        });
    }

    /// Positive estimate of the diagonal of the Hessian at x, for epsilon > 0 or a valid x.
    void diagonal(const Eigen::VectorXd& x, const EnergyMode& mode, Eigen::VectorXd& result) {
        this->sum_diagonal(x, result, [&](std::size_t cell, int simplex, const Matrix& edges) {
            Matrix slope;
            const Matrix& ideal = ideal_of(cell, simplex);
            const Matrix J = jacobian(cell, simplex, edges) * ideal;
            const Distortion W = distortion<D>(J, mode.epsilon, mode.theta, slope);
            const double metric =
                metric_.empty() ? 1.0 : metric_[metric_at(cell, simplex)].squaredNorm() / static_cast<double>(D);
            const CellPoints<D> rows = this->edge_rows(simplex, ideal);
            const CellPoints<D> by_det = cofactors<D>(J) * rows;
            return (weight_of(cell, simplex) * metric *
                    (W.shape_curvature * rows.colwise().squaredNorm() +
                     W.det_curvature / D * by_det.colwise().squaredNorm()))
                .transpose()
                .eval();
        });
    }

private:
    [[nodiscard]] Matrix jacobian(std::size_t cell, int simplex, const Matrix& edges) const {
        return metric_.empty() || simplex >= corners ? edges : (metric_[metric_at(cell, simplex)] * edges).eval();
    }
    [[nodiscard]] bool cubes() const { return to_ideal_.size() == 1; }
    [[nodiscard]] Matrix to_ideal(std::size_t cell, int simplex, const Matrix& edges) const {
        return cubes() ? edges : (edges * ideal_of(cell, simplex)).eval();
    }
    [[nodiscard]] static std::size_t metric_at(std::size_t cell, int simplex) {
        return cell * static_cast<std::size_t>(corners) + Base::at(simplex);
    }
    [[nodiscard]] const Matrix& ideal_of(std::size_t cell, int simplex) const {
        return cubes() ? to_ideal_[0] : to_ideal_[cell * this->simplices_per_cell() + Base::at(simplex)];
    }
    [[nodiscard]] double weight_of(std::size_t cell, int simplex) const {
        return weight_.size() == 1 ? weight_[0] : weight_[cell * this->simplices_per_cell() + Base::at(simplex)];
    }

    std::vector<Matrix> to_ideal_;
    std::vector<double> weight_;
    std::vector<Matrix> metric_;
    std::vector<EnergyValue> parts_;
};

}  // namespace pavior::detail
