#pragma once
/// \file
/// Untangling where the nodes move freely in the plane (quads) or in space (hexahedra).

#include <pavior/smooth/detail/cell_energy.hpp>
#include <pavior/smooth/detail/contradictions.hpp>
#include <pavior/smooth/detail/foldover.hpp>
#include <pavior/smooth/detail/untangle.hpp>

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
    [[nodiscard]] static bool concurrent(const Patch<D>&) { return true; }

    [[nodiscard]] double quality(Index c) const {
        return scaled_jacobian<D>(cell_points<D>(nodes_, cells_[c], unit_), samples_);
    }

    /// Gives up the corners that contradict each other, see ContradictionFinder.
    void find_hopeless(std::span<const Index> inverted, const PatchFinder<D>& finder) {
        const auto points = [&](Index c) { return cell_points<D>(nodes_, cells_[c], unit_); };
        given_up_ = ContradictionFinder<D, decltype(points)>(cells_, fixed_, finder, points).find(inverted);
    }

    /// What the quality of a cell cannot exceed: the smallest scaled determinant of the corners whose nodes are all
    /// fixed, 1 without such a corner; -1 with a corner that was given up.
    [[nodiscard]] double bound(Index c) const {
        const Corners& cell = cells_[c];
        double least = given_up_.empty() || given_up_[c] == 0 ? 1.0 : -1.0;
        for (std::size_t k = 0; k < cell.size(); ++k) {
            bool rigid = fixed_[cell[k]] != 0;
            for (const int n : CellTopology<D>::neighbours[k]) {
                rigid = rigid && fixed_[cell[static_cast<std::size_t>(n)]] != 0;
            }
            if (rigid) {
                const CellPoints<D> points = cell_points<D>(nodes_, cell, unit_);
                least = std::min(least, scaled_determinant<D>(corner_edges<D>(points, static_cast<int>(k))));
            }
        }
        return least;
    }

    /// A corner whose nodes are all fixed is inverted, or one was given up.
    [[nodiscard]] bool hopeless(Index c) const { return is_inverted(bound(c)); }

    [[nodiscard]] std::vector<Vector> save(const Patch<D>& patch) const {
        std::vector<Vector> saved(patch.free_count);
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            saved[k] = nodes_[patch.nodes[k]];
        }
        return saved;
    }
    /// One free node alone.
    void restore(const Patch<D>& patch, const std::vector<Vector>& saved, Index local) {
        nodes_[patch.nodes[local]] = saved[local];
    }
    void restore(const Patch<D>& patch, const std::vector<Vector>& saved) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            nodes_[patch.nodes[k]] = saved[k];
        }
    }

    int solve(const Patch<D>& patch, double wanted, const Execution& execution) {
        const Frame frame = frame_of(patch);
        CellEnergy<D> energy = energy_of(patch, frame, execution);
        return move_patch(energy, wanted, options_, [&](const Eigen::VectorXd& x) { write(patch, frame, x); });
    }

protected:
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

    [[nodiscard]] CellEnergy<D> energy_of(const Patch<D>& patch, const Frame& frame, const Execution& execution) const {
        CellEnergy<D> energy(coordinates(patch, frame), patch.cells, patch.free_count, samples_, execution);
        if (!reference_.empty()) {
            set_ideal(energy, patch);
        }
        leave_out(energy, patch);
        return energy;
    }

    /// Takes the corners that were given up out of a sum over \p patch.
    void leave_out(CellSum<D>& sum, const Patch<D>& patch) const {
        for (std::size_t k = 0; k < patch.cell_ids.size() && !given_up_.empty(); ++k) {
            sum.leave_out(k, given_up_[patch.cell_ids[k]]);
        }
    }

    [[nodiscard]] const UntangleOptions& options() const { return options_; }
    [[nodiscard]] Vector& node(Index i) { return nodes_[i]; }
    [[nodiscard]] int samples() const { return samples_; }

private:
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
    std::vector<std::uint32_t> given_up_;  ///< bit per corner of a cell; empty: none
};

/// Throws InputError for a mesh that no CartesianModel can take.
template <int D>
void check_mesh(std::span<Eigen::Matrix<double, D, 1>> nodes, std::span<const CellCorners<D>> cells,
                std::size_t fixed_count, std::span<const Eigen::Matrix<double, D, 1>> reference) {
    using Vector = Eigen::Matrix<double, D, 1>;
    check_cells<D>(cells, nodes.size(), fixed_count);
    check_finite<Vector>(nodes, "node");
    check_finite<Vector>(reference, "reference node");
    if (!reference.empty() && reference.size() != nodes.size()) {
        throw InputError(ErrorCode::size_mismatch, "the reference must have one node per node of the mesh, or none");
    }
}

/// Checks everything and runs a CartesianModel.
template <int D>
SmoothReport untangle_cartesian(std::span<Eigen::Matrix<double, D, 1>> nodes, std::span<const CellCorners<D>> cells,
                                std::span<const std::uint8_t> fixed, const UntangleOptions& options,
                                std::span<const Eigen::Matrix<double, D, 1>> reference) {
    check_options(options);
    check_mesh<D>(nodes, cells, fixed.size(), reference);
    CartesianModel<D> model(nodes, cells, fixed, reference, options);
    return done_or_undone(nodes, [&] { return Untangler<D, CartesianModel<D>>(model, cells, fixed, options).run(); });
}

}  // namespace pavior::detail
