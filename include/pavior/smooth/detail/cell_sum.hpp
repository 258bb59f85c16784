#pragma once
/// \file
/// Sums over the corner simplices and samples of the cells of a patch, with their gradient by the free nodes.

#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pavior::detail {

/// The simplices of cells of dimension D as a function of the free nodes 0 .. free-1 among their points. Each corner of
/// a cell is one simplex, and so is each sample. Simplices without a free node are left out.
/// sum() allocates nothing; the same bytes for any number of threads.
template <int D>
class CellSum {
public:
    using Corners = CellCorners<D>;
    using Matrix = Eigen::Matrix<double, D, D>;
    using Vector = Eigen::Matrix<double, D, 1>;
    static constexpr int corners = CellTopology<D>::corners;

    /// \param points   D x n coordinates, the free nodes first.
    /// \param cells    corner ids in [0, n).
    /// \param samples  how many of hex_samples count (D = 3).
    CellSum(Eigen::Matrix<double, D, Eigen::Dynamic> points, std::vector<Corners> cells, std::size_t free_count,
            int samples, Execution execution)
        : points_(std::move(points)),
          cells_(std::move(cells)),
          free_count_(free_count),
          simplices_(static_cast<std::size_t>(corners + samples)),
          execution_{cells_.size() < 4 * chunk ? 1 : execution.threads, execution.stop} {
        find_active();
        find_incidence();
        local_.resize(D, static_cast<Eigen::Index>(cells_.size()) * corners);
    }

    [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
    [[nodiscard]] std::size_t free_count() const { return free_count_; }
    [[nodiscard]] std::size_t simplices_per_cell() const { return simplices_; }
    [[nodiscard]] const std::vector<Corners>& cells() const { return cells_; }

    /// Leaves out corners of a cell, one bit each, and its samples if there is one.
    void leave_out(std::size_t cell, std::uint32_t corner_bits) {
        active_[cell] &= corner_bits != 0 ? ((1U << corners) - 1U) & ~corner_bits : ~0U;
    }

    /// Coordinates of the free nodes, one after the other.
    [[nodiscard]] Eigen::VectorXd free_nodes() const {
        return Eigen::Map<const Eigen::VectorXd>(points_.data(), static_cast<Eigen::Index>(free_count_) * D);
    }

    /// Called before each step of a continuation; nothing to do here.
    void refresh(const Eigen::VectorXd&) {}
    /// Brings x to where the nodes may be; nothing to do here.
    void settle(const Eigen::VectorXd&) {}

protected:
    static constexpr std::size_t chunk = 256;

    void set_free_nodes(const Eigen::VectorXd& x) { std::copy_n(x.data(), x.size(), points_.data()); }

    template <class Body>
    void each_simplex(std::size_t cell, Body&& body) const {
        for (std::uint32_t left = active_[cell]; left != 0; left &= left - 1) {
            body(std::countr_zero(left));
        }
    }

    /// Smallest measure(cell, simplex, edges) over the simplices that depend on a free node; 1 if there is none.
    template <class Measure>
    [[nodiscard]] double least(const Eigen::VectorXd& x, const Measure& measure) {
        set_free_nodes(x);
        double result = 1.0;
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const CellPoints<D> points = gather_points(cell);
            each_simplex(cell, [&](int simplex) {
                result = std::min(result, measure(cell, simplex, simplex_edges<D>(points, simplex)));
            });
        }
        return result;
    }

    /// Calls term(part, cell, simplex, edges, slope) -> bool for every simplex at x: it adds to the Part of its chunk
    /// and sets the slope by the edges, or returns false: then the rest of the chunk is left out and the gradient is of
    /// no use. The parts come in the order of the cells, one a chunk, and must number part_count().
    template <class Part, class Term>
    void sum(const Eigen::VectorXd& x, std::vector<Part>& parts, Eigen::VectorXd& gradient, const Term& term) {
        set_free_nodes(x);
        parallel_for(execution_, cells_.size(), chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t first = begin; first < end; first += chunk) {
                parts[first / chunk] = Part{};
                sum_chunk(first, std::min(end, first + chunk), parts[first / chunk], term);
            }
        });
        parallel_for(execution_, free_count_, chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                gather(i, gradient);
            }
        });
    }
    [[nodiscard]] std::size_t part_count() const { return (cells_.size() + chunk - 1) / chunk; }

    /// A diagonal that is the same for the D coordinates of a node: adds term(cell, simplex, edges), one value a corner
    /// of the cell, to the nodes there. Kept positive.
    template <class Term>
    void sum_diagonal(const Eigen::VectorXd& x, Eigen::VectorXd& result, const Term& term) {
        set_free_nodes(x);
        result.setZero(x.size());
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const CellPoints<D> points = gather_points(cell);
            each_simplex(cell, [&](int simplex) {
                const Eigen::Matrix<double, corners, 1> values = term(cell, simplex, simplex_edges<D>(points, simplex));
                for (int c = 0; c < corners; ++c) {
                    const Index i = cells_[cell][at(c)];
                    if (is_free(i)) {
                        result.template segment<D>(static_cast<Eigen::Index>(i) * D).array() += values[c];
                    }
                }
            });
        }
        result = result.cwiseMax(1e-12 * result.maxCoeff() + std::numeric_limits<double>::min());
    }

    /// Column c: the vector g with edges * to_ideal = sum x_c g_c^T.
    [[nodiscard]] static CellPoints<D> edge_rows(int simplex, const Matrix& to_ideal) {
        CellPoints<D> rows = CellPoints<D>::Zero();
        scatter(simplex, to_ideal.transpose(), rows);
        return rows;
    }

    [[nodiscard]] CellPoints<D> gather_points(std::size_t cell) const {
        CellPoints<D> points;
        for (int c = 0; c < corners; ++c) {
            points.col(c) = points_.col(static_cast<Eigen::Index>(cells_[cell][at(c)]));
        }
        return points;
    }

    [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

private:
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

    template <class Part, class Term>
    void sum_chunk(std::size_t first, std::size_t last, Part& part, const Term& term) {
        for (std::size_t cell = first; cell < last; ++cell) {
            CellPoints<D> gradient = CellPoints<D>::Zero();
            const CellPoints<D> points = gather_points(cell);
            for (std::uint32_t left = active_[cell]; left != 0; left &= left - 1) {
                const int simplex = std::countr_zero(left);
                Matrix slope;
                if (!term(part, cell, simplex, simplex_edges<D>(points, simplex), slope)) {
                    return;
                }
                scatter(simplex, slope, gradient);
            }
            local_.template middleCols<corners>(static_cast<Eigen::Index>(cell) * corners) = gradient;
        }
    }

    /// Adds the derivative by the edges of one simplex to the nodes of its cell.
    static void scatter(int simplex, const Matrix& by_edges, CellPoints<D>& gradient) {
        if (simplex < corners) {
            for (int k = 0; k < D; ++k) {
                gradient.col(CellTopology<D>::neighbours[at(simplex)][at(k)]) += by_edges.col(k);
                gradient.col(simplex) -= by_edges.col(k);
            }
        } else if constexpr (D == 3) {
            gradient.noalias() +=
                by_edges * Eigen::Map<const Eigen::Matrix<double, 3, 8>>(hex_samples[at(simplex - corners)][0].data());
        }
    }

    void gather(std::size_t i, Eigen::VectorXd& gradient) const {
        Vector sum = Vector::Zero();
        for (std::size_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
            sum += local_.col(static_cast<Eigen::Index>(incident_[k]));
        }
        gradient.template segment<D>(static_cast<Eigen::Index>(i) * D) = sum;
    }

    [[nodiscard]] bool is_free(Index i) const { return i < free_count_; }

    Eigen::Matrix<double, D, Eigen::Dynamic> points_;
    std::vector<Corners> cells_;
    std::size_t free_count_;
    std::size_t simplices_;
    Execution execution_;
    std::vector<std::uint32_t> active_;  ///< bit per simplex of a cell
    std::vector<std::size_t> offsets_, incident_;
    Eigen::Matrix<double, D, Eigen::Dynamic> local_;
};

}  // namespace pavior::detail
