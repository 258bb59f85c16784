#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/verify_quads.hpp>
#include <pavior/mesh/verify_report.hpp>
#include <pavior/sweep/harmonic_error.hpp>

#include <algorithm>

using namespace pavior;
using namespace pavior::test;

namespace {

Eigen::MatrixXd loop_values(const SweepProblem& p, const std::function<double(const Vec3&)>& f) {
    Eigen::MatrixXd values(static_cast<Eigen::Index>(p.loops.nodes.size()), 1);
    for (std::size_t i = 0; i < p.loops.nodes.size(); ++i) {
        values(static_cast<Eigen::Index>(i), 0) = f(p.source_nodes[p.loops.nodes[i]]);
    }
    return values;
}

HarmonicError operator_of(const SweepProblem& p) { return {p.source_nodes, p.quads, p.loops.nodes}; }

}  // namespace

TEST_CASE("linear and hyperbolic functions are harmonic on rectangular grids of uneven spacing") {
    const SweepProblem p = grid_problem(
        [](double x, double y, double t) { return Vec3(std::exp(x), 3 * y + y * y * y, t); }, {.cells = 8, .bump = 0});
    const std::function<double(const Vec3&)> functions[] = {[](const Vec3& x) { return 2 * x[0] - x[1] + 1; },
                                                            [](const Vec3& x) { return x[0] * x[1]; }};
    for (const auto& f : functions) {
        const Eigen::MatrixXd field = operator_of(p).prepare(loop_values(p, f)).field;
        for (std::size_t i = 0; i < p.source_nodes.size(); ++i) {
            const bool inner = std::find(p.loops.nodes.begin(), p.loops.nodes.end(), i) == p.loops.nodes.end();
            if (inner) {
                CHECK(field(static_cast<Eigen::Index>(i), 0) == Approx(f(p.source_nodes[i])).margin(1e-12));
            }
        }
    }
}

TEST_CASE("weights are positive and sum to 1, on distorted caps with holes too") {
    const SweepProblem p = grid_problem(warped(), {.cells = 7, .hole = 3, .bump = 0.4});
    const auto m = static_cast<Eigen::Index>(p.loops.nodes.size());
    const HarmonicError error = operator_of(p);
    const Eigen::MatrixXd weights = error.prepare(Eigen::MatrixXd::Identity(m, m)).field;
    CHECK(weights.minCoeff() > -1e-15);
    const Eigen::MatrixXd ones = error.prepare(Eigen::MatrixXd::Ones(m, 1)).field;
    for (std::size_t i = 0; i < p.source_nodes.size(); ++i) {
        const bool inner = std::find(p.loops.nodes.begin(), p.loops.nodes.end(), i) == p.loops.nodes.end();
        CHECK(ones(static_cast<Eigen::Index>(i), 0) == Approx(inner ? 1 : 0).margin(1e-12));
        CHECK(weights.row(static_cast<Eigen::Index>(i)).sum() == Approx(inner ? 1 : 0).margin(1e-12));
    }
}

TEST_CASE("a column has the same bits alone, among others and in parallel") {
    const SweepProblem p = grid_problem(warped());
    const Eigen::MatrixXd residuals = Eigen::MatrixXd::Random(static_cast<Eigen::Index>(p.loops.nodes.size()), 7);
    const HarmonicError error = operator_of(p);
    const Eigen::MatrixXd all = error.prepare(residuals).field;
    CHECK(error.prepare(residuals, {3}).field == all);
    for (Eigen::Index c = 0; c < residuals.cols(); ++c) {
        CHECK(error.prepare(residuals.col(c)).field == all.col(c));
    }
}

TEST_CASE("scale and place of the cap do not matter, coincident nodes do no harm") {
    const SweepProblem p = grid_problem(warped());
    const Eigen::MatrixXd residuals = Eigen::MatrixXd::Random(static_cast<Eigen::Index>(p.loops.nodes.size()), 2);
    const Eigen::MatrixXd field = operator_of(p).prepare(residuals).field;
    for (const double scale : {1e-200, 1e-6, 1e200}) {
        const SweepProblem q = moved(p, [=](const Vec3& x) { return Vec3(x * scale); });
        CHECK((operator_of(q).prepare(residuals).field - field).norm() < 1e-10);
    }
    SweepProblem pinched = p;
    pinched.source_nodes[16] = pinched.source_nodes[17];
    CHECK(operator_of(pinched).prepare(residuals).field.allFinite());
}

TEST_CASE("nodes that no quads connect to the loops are refused") {
    // A closed box beside the cap: its nodes reach no loop.
    SweepProblem p = grid_problem(straight());
    const auto first = static_cast<Index>(p.source_nodes.size());
    for (int i = 0; i < 8; ++i) {
        p.source_nodes.emplace_back(5.0 + (i & 1), (i >> 1) & 1, (i >> 2) & 1);
    }
    for (const QuadCorners& q : {QuadCorners{0, 2, 3, 1}, QuadCorners{4, 5, 7, 6}, QuadCorners{0, 1, 5, 4},
                                 QuadCorners{2, 6, 7, 3}, QuadCorners{0, 4, 6, 2}, QuadCorners{1, 3, 7, 5}}) {
        p.quads.push_back({first + q[0], first + q[1], first + q[2], first + q[3]});
    }
    CHECK_THROWS_AS(operator_of(p), InputError);
}
