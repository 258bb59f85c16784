#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/sweep/inverse_distance_error.hpp>

#include <algorithm>
#include <cstring>

using namespace pavior;
using namespace pavior::test;

namespace {

// Corrections of all nodes, column by column: n x c.
Eigen::MatrixXd field(const InverseDistanceError& error, std::size_t n, const Eigen::MatrixXd& residuals,
                      InstructionSet instructions = best_instruction_set()) {
    const std::size_t stride = (n + 15) / 16 * 16;
    const auto columns = static_cast<std::size_t>(residuals.cols());
    std::vector<double> out(stride * columns, 0.0);
    error.add(error.prepare(residuals), 0, n, out.data(), stride, instructions);
    Eigen::MatrixXd result(n, residuals.cols());
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; i < n; ++i) {
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = out[c * stride + i];
        }
    }
    return result;
}

}  // namespace

TEST_CASE("weights are positive, sum to 1 and fall with the squared distance") {
    const SweepProblem p = grid_problem(warped(), {.cells = 5, .hole = 1});
    const InverseDistanceError error(p.source_nodes, p.loops.nodes);
    for (std::size_t i = 0; i < p.source_nodes.size(); ++i) {
        const std::vector<double> w = error.weights(i);
        REQUIRE(w.size() == p.loops.nodes.size());
        double sum = 0;
        for (std::size_t k = 0; k < w.size(); ++k) {
            CHECK(w[k] >= 0);
            sum += w[k];
        }
        CHECK(sum == Approx(1).epsilon(1e-14));
        const auto on_loop = std::find(p.loops.nodes.begin(), p.loops.nodes.end(), i);
        if (on_loop != p.loops.nodes.end()) {
            CHECK(w[static_cast<std::size_t>(on_loop - p.loops.nodes.begin())] == 1);
            continue;
        }
        for (std::size_t k = 1; k < w.size(); ++k) {
            const double d0 = (p.source_nodes[i] - p.source_nodes[p.loops.nodes[0]]).squaredNorm();
            const double dk = (p.source_nodes[i] - p.source_nodes[p.loops.nodes[k]]).squaredNorm();
            CHECK(w[k] / w[0] == Approx(d0 / dk).epsilon(1e-12));
        }
    }
}

TEST_CASE("the field is the weighted mean of the residuals, at any scale and place") {
    const SweepProblem p = grid_problem(warped(), {.cells = 6, .hole = 2});
    const auto m = static_cast<Eigen::Index>(p.loops.nodes.size());
    const Eigen::MatrixXd residuals = Eigen::MatrixXd::Random(m, 14);
    const InverseDistanceError error(p.source_nodes, p.loops.nodes);
    const Eigen::MatrixXd values = field(error, p.source_nodes.size(), residuals);
    for (std::size_t i = 0; i < p.source_nodes.size(); ++i) {
        const std::vector<double> w = error.weights(i);
        const Eigen::RowVectorXd want = Eigen::Map<const Eigen::RowVectorXd>(w.data(), m) * residuals;
        CHECK((values.row(static_cast<Eigen::Index>(i)) - want).norm() < 1e-13);
    }
    for (const double scale : {1e-200, 1e-6, 1e6, 1e200}) {
        const SweepProblem q = moved(p, [=](const Vec3& x) { return Vec3(scale * (x + Vec3(1, 2, 3))); });
        const InverseDistanceError scaled(q.source_nodes, q.loops.nodes);
        const Eigen::MatrixXd big = field(scaled, q.source_nodes.size(), residuals * scale);
        CHECK((big / scale - values).norm() < 1e-12);
    }
}

TEST_CASE("a node in the place of loop nodes takes their residual") {
    std::vector<Vec3> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0.5, 0.5, 0}};
    const std::vector<Index> loop{0, 1, 2, 3};
    Eigen::MatrixXd residuals(4, 1);
    residuals << 1, 5, 3, -1;
    const Eigen::MatrixXd values = field(InverseDistanceError(nodes, loop), nodes.size(), residuals);
    CHECK(values(4, 0) == 5);
    CHECK(values(5, 0) == Approx(2).epsilon(1e-15));
    nodes[2] = nodes[1];
    CHECK(field(InverseDistanceError(nodes, loop), nodes.size(), residuals)(4, 0) == 4);
}

TEST_CASE("a column has the same bits alone, among others, and with any instructions") {
    const SweepProblem p = grid_problem(warped());
    const Eigen::MatrixXd residuals = Eigen::MatrixXd::Random(static_cast<Eigen::Index>(p.loops.nodes.size()), 29);
    const InverseDistanceError error(p.source_nodes, p.loops.nodes);
    const Eigen::MatrixXd all = field(error, p.source_nodes.size(), residuals);
    for (Eigen::Index c = 0; c < residuals.cols(); ++c) {
        CHECK(field(error, p.source_nodes.size(), residuals.col(c)) == all.col(c));
    }
    CHECK(field(error, p.source_nodes.size(), residuals, InstructionSet::scalar) == all);
}
