#pragma once
/// \file
/// Untangling where the nodes move freely in the plane (quads) or in space (hexahedra).

#include <pavior/smooth/detail/cell_energy.hpp>
#include <pavior/smooth/detail/foldover.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/lbfgs.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior::detail {

/// The smoothing_model of plane quads (D = 2) and hexahedra (D = 3).
template <int D>
class CartesianModel {
public:
    using Corners = CellCorners<D>;
    using Matrix = Eigen::Matrix<double, D, D>;
    using Vector = Eigen::Matrix<double, D, 1>;

    CartesianModel(std::span<Vector> nodes, std::span<const Corners> cells, std::span<const std::uint8_t> fixed,
                   std::span<const Vector> reference, const UntangleOptions& options)
        : nodes_(nodes),
          cells_(cells),
          fixed_(fixed),
          reference_(reference),
          options_(options),
          samples_(sample_count<D>(options.positivity)),
          unit_(unit_of<D>(nodes)),
          reference_unit_(unit_of<D>(reference)) {}

    [[nodiscard]] static bool concurrent() { return true; }

    [[nodiscard]] double quality(Index c) const {
        return scaled_jacobian<D>(cell_points<D>(nodes_, cells_[c], unit_), samples_);
    }

    /// A corner whose nodes are all fixed is inverted.
    [[nodiscard]] bool hopeless(Index c) const {
        const Corners& cell = cells_[c];
        for (std::size_t k = 0; k < cell.size(); ++k) {
            bool rigid = fixed_[cell[k]] != 0;
            for (const int n : CellTopology<D>::neighbours[k]) {
                rigid = rigid && fixed_[cell[static_cast<std::size_t>(n)]] != 0;
            }
            const Matrix edges = corner_edges<D>(cell_points<D>(nodes_, cell, unit_), static_cast<int>(k));
            if (rigid && !(scaled_determinant<D>(edges) > inverted_tolerance)) {
                return true;
            }
        }
        return false;
    }

    void save(const Patch<D>& patch) {
        saved_.resize(patch.free_count);
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            saved_[k] = nodes_[patch.nodes[k]];
        }
    }
    void restore(const Patch<D>& patch) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            nodes_[patch.nodes[k]] = saved_[k];
        }
    }

    int solve(const Patch<D>& patch, double wanted) {
        const Frame frame = frame_of(patch);
        CellEnergy<D> energy(coordinates(patch, frame), patch.cells, patch.free_count, samples_, options_.execution);
        if (!reference_.empty()) {
            set_ideal(energy, patch);
        }
        const FoldoverOptions limits{options_.max_iterations, options_.inner_iterations, options_.theta};
        const Eigen::VectorXd start = energy.free_nodes();
        Eigen::VectorXd x = start;
        const int iterations = solve_patch(energy, x, wanted, limits, lbfgs_);
        if (x != start) {
            write(patch, frame, x);
        }
        return iterations;
    }

private:
    /// Local coordinates of a patch: (x - origin) / size.
    struct Frame {
        Vector origin;
        double size = 1.0;
    };

    /// Origin: mean of the nodes of the patch. Size: side of a square or cube with the mean measure of its cells, which
    /// the boundary of the patch determines; from the lengths of the edges where that is not positive.
    [[nodiscard]] Frame frame_of(const Patch<D>& patch) const {
        Frame frame{Vector::Zero(), 0.0};
        double measure = 0.0;
        double edge = 0.0;
        const double share = 1.0 / static_cast<double>(patch.cells.size());
        for (const Index c : patch.cell_ids) {
            const CellPoints<D> cell = cell_points<D>(nodes_, cells_[c], unit_);
            measure += share * signed_measure<D>(cell);
            edge += share * std::pow(corner_edges<D>(cell, 0).colwise().norm().mean(), D);
        }
        const double size = std::pow(measure > 1e-9 * edge ? measure : std::max(edge, 1e-300), 1.0 / D);
        frame.size = size * unit_;
        for (const Index i : patch.nodes) {
            frame.origin += (nodes_[i] - nodes_[patch.nodes[0]]) / unit_ / static_cast<double>(patch.nodes.size());
        }
        frame.origin = frame.origin * unit_ + nodes_[patch.nodes[0]];
        return frame;
    }

    [[nodiscard]] Eigen::Matrix<double, D, Eigen::Dynamic> coordinates(const Patch<D>& patch,
                                                                       const Frame& frame) const {
        Eigen::Matrix<double, D, Eigen::Dynamic> result(D, static_cast<Eigen::Index>(patch.nodes.size()));
        for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
            result.col(static_cast<Eigen::Index>(k)) = (nodes_[patch.nodes[k]] - frame.origin) / frame.size;
        }
        return result;
    }

    void write(const Patch<D>& patch, const Frame& frame, const Eigen::VectorXd& x) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            nodes_[patch.nodes[k]] = frame.origin + frame.size * x.segment<D>(static_cast<Eigen::Index>(k) * D);
        }
    }

    /// Ideal simplices from the reference, scaled so that their mean measure is 1, weighted by it; squares or cubes
    /// where a reference cell is degenerate.
    void set_ideal(CellEnergy<D>& energy, const Patch<D>& patch) const {
        const std::size_t simplices = energy.simplices_per_cell();
        std::vector<Matrix> edges(patch.cells.size() * simplices);
        std::vector<double> weight(edges.size(), 0.0);
        double sum = 0.0;
        std::size_t good = 0;
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const CellPoints<D> cell =
                cell_points<D>(reference_, cells_[patch.cell_ids[k / simplices]], reference_unit_);
            edges[k] = simplex_edges<D>(cell, static_cast<int>(k % simplices));
            if (scaled_determinant<D>(edges[k]) > 1e-3) {
                weight[k] = edges[k].determinant();
                sum += weight[k];
                ++good;
            }
        }
        const double mean = good != 0 ? sum / static_cast<double>(good) : 1.0;
        const double size = std::pow(mean, 1.0 / D);
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const bool degenerate = weight[k] <= 0.0;
            weight[k] = degenerate ? 1.0 : weight[k] / mean;
            edges[k] = degenerate ? Matrix::Identity().eval() : (edges[k].inverse() * size).eval();
        }
        energy.set_ideal(std::move(edges), std::move(weight));
    }

    std::span<Vector> nodes_;
    std::span<const Corners> cells_;
    std::span<const std::uint8_t> fixed_;
    std::span<const Vector> reference_;
    const UntangleOptions& options_;
    int samples_;
    double unit_;
    double reference_unit_;
    std::vector<Vector> saved_;
    Lbfgs lbfgs_;
};

/// Runs a CartesianModel and fills in what only the coordinates tell.
template <int D>
SmoothReport untangle_cartesian(std::span<Eigen::Matrix<double, D, 1>> nodes, std::span<const CellCorners<D>> cells,
                                std::span<const std::uint8_t> fixed, const UntangleOptions& options,
                                std::span<const Eigen::Matrix<double, D, 1>> reference) {
    using Vector = Eigen::Matrix<double, D, 1>;
    check_options(options);
    check_cells<D>(cells, nodes.size(), fixed.size());
    check_finite<Vector>(nodes, "node");
    check_finite<Vector>(reference, "reference node");
    if (!reference.empty() && reference.size() != nodes.size()) {
        throw InputError(ErrorCode::size_mismatch, "the reference must have one node per node of the mesh, or none");
    }
    CartesianModel<D> model(nodes, cells, fixed, reference, options);
    return Untangler<D, CartesianModel<D>>(model, cells, fixed, options).run();
}

}  // namespace pavior::detail
