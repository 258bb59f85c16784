#pragma once
/// \file
/// The regularised distortion summed over the cells of a patch, and its gradient.

#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/distortion.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pavior::detail {

/// Energy of a patch at one point.
struct EnergyValue {
    double energy = 0.0;          ///< infinity where the barrier is violated
    double min_det = 0.0;         ///< smallest determinant of the Jacobians from the ideal to the actual simplices
    double max_distortion = 0.0;  ///< largest distortion, >= 1
};

/// How the energy treats bad simplices.
struct EnergyMode {
    double epsilon = 1.0;  ///< regularisation; 0: infinite unless every determinant is positive
    double theta = 0.5;    ///< weight of the volume term
    double ceiling = 0.0;  ///< t >= 0: W / (1 - t W) instead of W, infinite unless t W < 1 everywhere
};

/// Sum of weight * W(J) over the simplices of cells of dimension D, as a function of the free nodes.
/// Nodes 0 .. free-1 are free, the others fixed; J = metric * [edges of a corner] * to_ideal. Each corner of a cell is
/// one simplex, and so is each sample. Simplices without a free node are left out.
/// evaluate() allocates nothing; the same bytes for any number of threads.
template <int D>
class CellEnergy {
public:
    using Corners = CellCorners<D>;
    using Matrix = Eigen::Matrix<double, D, D>;
    using Vector = Eigen::Matrix<double, D, 1>;
    static constexpr int corners = CellTopology<D>::corners;

    /// \param points   D x n coordinates, the free nodes first.
    /// \param cells    corner ids in [0, n).
    /// \param samples  how many of hex_samples count (D = 3).
    CellEnergy(Eigen::Matrix<double, D, Eigen::Dynamic> points, std::vector<Corners> cells, std::size_t free_count,
               int samples, Execution execution)
        : points_(std::move(points)),
          cells_(std::move(cells)),
          free_count_(free_count),
          simplices_(static_cast<std::size_t>(corners + samples)),
          execution_(cells_.size() < 4 * chunk ? sequential : execution),
          to_ideal_{Matrix::Identity()},
          weight_{1.0} {
        find_active();
        find_incidence();
        local_.resize(D, static_cast<Eigen::Index>(cells_.size()) * corners);
        partial_.resize((cells_.size() + chunk - 1) / chunk);
    }

    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
    [[nodiscard]] std::size_t free_count() const { return free_count_; }
    [[nodiscard]] std::size_t simplices_per_cell() const { return simplices_; }
    [[nodiscard]] const std::vector<Corners>& cells() const { return cells_; }

    /// Ideal shapes: one inverse edge matrix and weight per simplex, cell by cell, corners first, then samples.
    void set_ideal(std::vector<Matrix> to_ideal, std::vector<double> weight) {
        to_ideal_ = std::move(to_ideal);
        weight_ = std::move(weight);
    }

    /// Square roots of the metric: one matrix per corner, cell by cell (surfaces, D = 2).
    void set_metric(std::vector<Matrix> metric) { metric_ = std::move(metric); }

    /// Coordinates of the free nodes, one after the other.
    [[nodiscard]] Eigen::VectorXd free_nodes() const {
        return Eigen::Map<const Eigen::VectorXd>(points_.data(), static_cast<Eigen::Index>(free_count_) * D);
    }

    /// Energy at x and its gradient, as long as x.
    EnergyValue evaluate(const Eigen::VectorXd& x, const EnergyMode& mode, Eigen::VectorXd& gradient) {
        std::copy_n(x.data(), x.size(), points_.data());
        parallel_for(execution_, cells_.size(), chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t first = begin; first < end; first += chunk) {
                partial_[first / chunk] = sum_chunk(first, std::min(end, first + chunk), mode);
            }
        });
        parallel_for(execution_, free_count_, chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                gather(i, gradient);
            }
        });
        return combine();
    }

    /// Positive estimate of the diagonal of the Hessian at x, for epsilon > 0 or a valid x.
    void diagonal(const Eigen::VectorXd& x, const EnergyMode& mode, Eigen::VectorXd& result) {
        std::copy_n(x.data(), x.size(), points_.data());
        result.setZero(x.size());
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            add_diagonal(cell, mode, result);
        }
        const double least = 1e-12 * result.maxCoeff() + std::numeric_limits<double>::min();
        result = result.cwiseMax(least);
    }

    /// Smallest scaled determinant over the simplices that depend on a free node; 1 if there is none.
    [[nodiscard]] double quality(const Eigen::VectorXd& x) {
        std::copy_n(x.data(), x.size(), points_.data());
        double least = 1.0;
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const CellPoints<D> points = gather_points(cell);
            for (std::uint32_t left = active_[cell]; left != 0; left &= left - 1) {
                least = std::min(least, scaled_determinant<D>(jacobian(cell, std::countr_zero(left), points)));
            }
        }
        return least;
    }

    /// Called before each step of epsilon; nothing to do here.
    void refresh(const Eigen::VectorXd&) {}

private:
    static constexpr std::size_t chunk = 256;

    void find_active() {
        active_.assign(cells_.size(), 0);
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            for (int c = 0; c < corners; ++c) {
                bool depends = is_free(cells_[cell][at(c)]);
                for (const int k : CellTopology<D>::neighbours[at(c)]) {
                    depends = depends || is_free(cells_[cell][at(k)]);
                }
                active_[cell] |= depends ? 1U << c : 0U;
            }
            if (active_[cell] != 0) {
                active_[cell] |= ((1U << simplices_) - 1U) & ~((1U << corners) - 1U);
            }
        }
    }

    void find_incidence() {
        offsets_.assign(free_count_ + 1, 0);
        for (const Corners& cell : cells_) {
            for (const Index i : cell) {
                offsets_[std::min<std::size_t>(i, free_count_ - 1) + 1] += is_free(i) ? 1U : 0U;
            }
        }
        for (std::size_t i = 0; i < free_count_; ++i) {
            offsets_[i + 1] += offsets_[i];
        }
        incident_.resize(offsets_.back());
        std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
        for (std::size_t slot = 0; slot < cells_.size() * corners; ++slot) {
            const Index i = cells_[slot / corners][slot % corners];
            if (is_free(i)) {
                incident_[next[i]++] = slot;
            }
        }
    }

    EnergyValue sum_chunk(std::size_t first, std::size_t last, const EnergyMode& mode) {
        EnergyValue sum{0.0, std::numeric_limits<double>::infinity(), 0.0};
        for (std::size_t cell = first; cell < last; ++cell) {
            CellPoints<D> gradient = CellPoints<D>::Zero();
            const CellPoints<D> points = gather_points(cell);
            for (std::uint32_t left = active_[cell]; left != 0; left &= left - 1) {
                const int simplex = std::countr_zero(left);
                Matrix slope;
                const Matrix& to_ideal = ideal(cell, simplex);
                const Distortion W =
                    distortion<D>(jacobian(cell, simplex, points) * to_ideal, mode.epsilon, mode.theta, slope);
                const double room = 1.0 - mode.ceiling * W.value;
                sum.min_det = std::min(sum.min_det, W.det);
                sum.max_distortion = std::max(sum.max_distortion, W.value);
                if (!(room > 0.0) || (mode.epsilon == 0.0 && !(W.det > 0.0))) {
                    sum.energy = std::numeric_limits<double>::infinity();
                    return sum;
                }
                const double weight = weight_of(cell, simplex);
                sum.energy += weight * W.value / room;
                slope *= weight / (room * room);
                scatter(cell, simplex, slope * to_ideal.transpose(), gradient);
            }
            local_.template middleCols<corners>(static_cast<Eigen::Index>(cell) * corners) = gradient;
        }
        return sum;
    }

    /// Adds the derivative by the edges of one simplex to the nodes of its cell.
    void scatter(std::size_t cell, int simplex, Matrix by_edges, CellPoints<D>& gradient) const {
        if (simplex < corners) {
            if (!metric_.empty()) {
                by_edges = (metric_[cell * corners + at(simplex)].transpose() * by_edges).eval();
            }
            for (int k = 0; k < D; ++k) {
                gradient.col(CellTopology<D>::neighbours[at(simplex)][at(k)]) += by_edges.col(k);
                gradient.col(simplex) -= by_edges.col(k);
            }
        } else if constexpr (D == 3) {
            gradient.noalias() += by_edges * sample_matrix(simplex);
        }
    }

    void gather(std::size_t i, Eigen::VectorXd& gradient) const {
        Vector sum = Vector::Zero();
        for (std::size_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
            sum += local_.col(static_cast<Eigen::Index>(incident_[k]));
        }
        gradient.template segment<D>(static_cast<Eigen::Index>(i) * D) = sum;
    }

    [[nodiscard]] EnergyValue combine() const {
        EnergyValue total{0.0, std::numeric_limits<double>::infinity(), 0.0};
        for (const EnergyValue& part : partial_) {
            total.energy += part.energy;
            total.min_det = std::min(total.min_det, part.min_det);
            total.max_distortion = std::max(total.max_distortion, part.max_distortion);
        }
        return total;
    }

    void add_diagonal(std::size_t cell, const EnergyMode& mode, Eigen::VectorXd& result) const {
        const CellPoints<D> points = gather_points(cell);
        for (std::uint32_t left = active_[cell]; left != 0; left &= left - 1) {
            const int simplex = std::countr_zero(left);
            Matrix slope;
            const Matrix& to_ideal = ideal(cell, simplex);
            const Matrix J = jacobian(cell, simplex, points) * to_ideal;
            const Distortion W = distortion<D>(J, mode.epsilon, mode.theta, slope);
            const double metric =
                simplex < corners && !metric_.empty() ? metric_[cell * corners + at(simplex)].squaredNorm() / D : 1.0;
            CellPoints<D> rows = CellPoints<D>::Zero();
            scatter_rows(simplex, to_ideal, rows);
            const CellPoints<D> by_det = cofactors<D>(J) * rows;
            for (int c = 0; c < corners; ++c) {
                const double value =
                    W.shape_curvature * rows.col(c).squaredNorm() + W.det_curvature * by_det.col(c).squaredNorm() / D;
                const Index i = cells_[cell][at(c)];
                if (is_free(i)) {
                    result.template segment<D>(static_cast<Eigen::Index>(i) * D).array() +=
                        weight_of(cell, simplex) * metric * value;
                }
            }
        }
    }

    /// Column c: the vector g with J = sum x_c g_c^T.
    static void scatter_rows(int simplex, const Matrix& to_ideal, CellPoints<D>& rows) {
        if (simplex < corners) {
            for (int k = 0; k < D; ++k) {
                rows.col(CellTopology<D>::neighbours[at(simplex)][at(k)]) += to_ideal.row(k).transpose();
                rows.col(simplex) -= to_ideal.row(k).transpose();
            }
        } else if constexpr (D == 3) {
            rows.noalias() = to_ideal.transpose() * sample_matrix(simplex);
        }
    }

    [[nodiscard]] CellPoints<D> gather_points(std::size_t cell) const {
        CellPoints<D> points;
        for (int c = 0; c < corners; ++c) {
            points.col(c) = points_.col(static_cast<Eigen::Index>(cells_[cell][at(c)]));
        }
        return points;
    }

    [[nodiscard]] Matrix jacobian(std::size_t cell, int simplex, const CellPoints<D>& points) const {
        if constexpr (D == 3) {
            if (simplex >= corners) {
                return points * sample_matrix(simplex).transpose();
            }
        }
        Matrix edges = corner_edges<D>(points, simplex);
        if (!metric_.empty()) {
            edges = (metric_[cell * corners + at(simplex)] * edges).eval();
        }
        return edges;
    }

    static auto sample_matrix(int simplex) {
        return Eigen::Map<const Eigen::Matrix<double, 3, 8>>(hex_samples[at(simplex - corners)][0].data());
    }

    [[nodiscard]] const Matrix& ideal(std::size_t cell, int simplex) const {
        return to_ideal_.size() == 1 ? to_ideal_[0] : to_ideal_[cell * simplices_ + at(simplex)];
    }
    [[nodiscard]] double weight_of(std::size_t cell, int simplex) const {
        return weight_.size() == 1 ? weight_[0] : weight_[cell * simplices_ + at(simplex)];
    }
    [[nodiscard]] bool is_free(Index i) const { return i < free_count_; }
    [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    Eigen::Matrix<double, D, Eigen::Dynamic> points_;
    std::vector<Corners> cells_;
    std::size_t free_count_;
    std::size_t simplices_;
    Execution execution_;
    std::vector<Matrix> to_ideal_;
    std::vector<double> weight_;
    std::vector<Matrix> metric_;
    std::vector<std::uint32_t> active_;  ///< bit per simplex of a cell
    std::vector<std::size_t> offsets_, incident_;
    Eigen::Matrix<double, D, Eigen::Dynamic> local_;
    std::vector<EnergyValue> partial_;
};

}  // namespace pavior::detail
