#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/loop_pair.hpp>

#include <limits>

using namespace pavior;

TEST_CASE("The condensed pair has the inner products of the centred loops") {
    test::for_dimensions_and_seeds(10, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        test::Random random(seed);
        const test::Points<N> X = 3 * random.points<N>(40 * seed);
        const test::Points<N> Y = 0.1 * random.points<N>(40 * seed);
        const test::Points<N> Xbar = X.colwise() - X.rowwise().mean();
        const test::Points<N> Ybar = Y.colwise() - Y.rowwise().mean();
        const auto pair = loop_pair(X, Y);
        const double tolerance = 1e-13 * seed;
        const double sx = pair.source.scale;
        const double sy = pair.target.scale;
        CHECK((pair.X.transpose() * pair.X - Xbar * Xbar.transpose() / (sx * sx)).norm() < tolerance);
        CHECK((pair.X.transpose() * pair.Y - Xbar * Ybar.transpose() / (sx * sy)).norm() < tolerance);
        CHECK((pair.Y.transpose() * pair.Y - Ybar * Ybar.transpose() / (sy * sy)).norm() < tolerance);
        CHECK(pair.ratio() == sy / sx);
        const Eigen::Matrix<double, N, 1> d = Y.rowwise().mean() - X.rowwise().mean();
        CHECK((pair.displacement() - d).norm() < 1e-14);
        CHECK((pair.map(Eigen::Matrix<double, N, N>::Identity())(X.col(0)) - X.col(0) - d).norm() < 1e-14);
    });
}

TEST_CASE("A map between far loops keeps the digits of the target") {
    test::Random random(5);
    const test::Points<3> X = random.points<3>(20).array() + 1e9;
    const test::Points<3> Y = X.array() - 1e9;
    const auto map = loop_pair(X, Y).map(Eigen::Matrix3d::Identity());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        CHECK((map(X.col(i)) - Y.col(i)).norm() < 1e-14);
    }
}

TEST_CASE("Bad input to a pair") {
    const test::Points<3> X = test::Random(1).points<3>(6);
    CHECK_THROWS_AS(loop_pair(X, test::Points<3>(X.leftCols(5))), InputError);
    CHECK_THROWS_AS(loop_pair(test::Points<3>(3, 0), test::Points<3>(3, 0)), InputError);
    const Eigen::MatrixXd flat = Eigen::MatrixXd::Random(2, 6);
    CHECK_THROWS_AS(loop_pair(Eigen::MatrixXd(X), flat), InputError);
    test::Points<3> bad = X;
    bad(0, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(loop_pair(bad, X).finite());
    CHECK_FALSE(loop_pair(X, bad).finite());
    CHECK(loop_pair(X, X).finite());
}
