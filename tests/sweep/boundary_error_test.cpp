#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/verify_quads.hpp>
#include <pavior/mesh/verify_report.hpp>
#include <pavior/sweep/boundary_error.hpp>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("each correction has its name") {
    CHECK(to_string(BoundaryCorrection::idw) == "idw");
    CHECK(to_string(BoundaryCorrection::harmonic) == "harmonic");
    CHECK(to_string(BoundaryCorrection::none) == "none");
}

TEST_CASE("the operator adds what its method gives, for any range of nodes") {
    const SweepProblem p = grid_problem(warped());
    const std::size_t n = p.source_nodes.size();
    const Eigen::MatrixXd residuals = Eigen::MatrixXd::Random(static_cast<Eigen::Index>(p.loops.nodes.size()), 6);
    const std::size_t stride = (n + 15) / 16 * 16;
    for (const auto kind : {BoundaryCorrection::idw, BoundaryCorrection::harmonic, BoundaryCorrection::none}) {
        const BoundaryError error(kind, p.source_nodes, p.quads, p.loops.nodes);
        const auto prepared = error.prepare(residuals);
        std::vector<double> whole(stride * 6, 0.25);
        error.add(prepared, 0, n, whole.data(), stride);
        std::vector<double> part(stride * 6, 0.25);
        error.add(prepared, 16, n, part.data(), stride);
        bool changed = false;
        for (std::size_t c = 0; c < 6; ++c) {
            for (std::size_t i = 16; i < n; ++i) {
                REQUIRE(part[c * stride + i - 16] == whole[c * stride + i]);
                changed = changed || whole[c * stride + i] != 0.25;
            }
        }
        CHECK(changed == (kind != BoundaryCorrection::none));
    }
}

TEST_CASE("a constant residual is corrected by itself") {
    const SweepProblem p = grid_problem(warped());
    const std::size_t n = p.source_nodes.size();
    const std::size_t stride = (n + 15) / 16 * 16;
    const auto m = static_cast<Eigen::Index>(p.loops.nodes.size());
    const Index inner = 24;
    for (const auto kind : {BoundaryCorrection::idw, BoundaryCorrection::harmonic}) {
        const BoundaryError error(kind, p.source_nodes, p.quads, p.loops.nodes);
        std::vector<double> out(stride, 0.0);
        error.add(error.prepare(Eigen::MatrixXd::Constant(m, 1, 0.75)), 0, n, out.data(), stride);
        CHECK(out[inner] == Approx(0.75).epsilon(1e-13));
    }
}
