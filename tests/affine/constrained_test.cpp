#include "affine/noise_setups.hpp"
#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/constrained.hpp>
#include <pavior/affine/fit.hpp>
#include <pavior/affine/functionals.hpp>
#include <pavior/affine/minimizers.hpp>
#include <pavior/affine/theta.hpp>

#include <cmath>

using namespace pavior;
using test::Offsets;
using test::one_loop;
using test::Points;
using test::Random;

namespace {

constexpr auto constrained = AffineMethod::constrained;

/// Open curves in the plane, closed loops in space, hyperplanar sets in four dimensions.
template <int N>
Points<N> random_loops(Random& random, Eigen::Index m) {
    if constexpr (N == 3) {
        return random.orthogonal<3>() * random.loop(m, 0.4);
    } else if constexpr (N == 4) {
        return random.hyperplanar<4>(m, random.unit<4>(), random.vector<4>());
    } else {
        Points<2> X = 0.2 * random.points<2>(m);
        X.row(0) += Eigen::RowVectorXd::LinSpaced(m, -1, 1);
        return random.orthogonal<2>() * X;
    }
}

}  // namespace

TEST_CASE("The constrained map is the minimiser of F under A nX = nY") {
    test::for_dimensions_and_seeds(20, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        Random random(seed);
        const Points<N> X = random_loops<N>(random, 20);
        const Points<N> Y = random.linear<N>() * X + 0.05 * random_loops<N>(random, 20);
        const auto fit = fit_affine(constrained, X, N == 4 ? Points<N>(random.linear<N>() * X) : Y, one_loop<N>(X));
        REQUIRE(fit.status == FitStatus::ok);
        CHECK(fit.uX.norm() == Approx(1));
        CHECK((fit.map.A * fit.uX - fit.uY).norm() < 1e-13);
        if (N == 4) {
            CHECK(fit.residual < 1e-13);
            return;
        }
        const double minimum = functional_f(fit.map.A, X, Y);
        for (int repeat = 0; repeat < 10; ++repeat) {
            Eigen::Matrix<double, N, N> change = 1e-3 * random.matrix<N, N>();
            change -= (change * fit.uX).eval() * fit.uX.transpose();
            const double plus = functional_f(fit.map.A + change, X, Y);
            const double minus = functional_f(fit.map.A - change, X, Y);
            CHECK(plus > minimum);
            CHECK(plus - minus == Approx(0).margin(1e-13 * static_cast<double>(X.cols())));
        }
    });
}

TEST_CASE("It is the limit of argmin H as the weight of the second term grows") {
    for (int seed = 1; seed <= 10; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.loop(20, 0.4);
        const Points<3> Y = random.orthogonal<3>() * random.loop(20, 0.4);
        const auto fit = fit_affine(constrained, X, Y, one_loop<3>(X));
        double previous = 1e300;
        for (const double weight : {1e1, 1e2, 1e3}) {
            const auto H = minimizer_h<double, 3>(loop_pair(X, Y), weight * fit.uX, weight * fit.uY);
            const double distance = (H.A - fit.map.A).norm();
            CHECK(distance < 0.02 * previous);
            previous = distance;
        }
        CHECK(previous < 1e-4);
    }
}

TEST_CASE("Planar X: Theta of A^F and argmin H; X and Y planar: Algorithm 3.1") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = (random.orthogonal<3>() * random.loop(20, 0)).colwise() + random.vector<3>();
        const Points<3> Y = random.orthogonal<3>() * random.loop(20, 0.4);
        const Points<3> flat = (random.orthogonal<3>() * random.loop(20, 0)).colwise() + random.vector<3>();
        const auto fit = fit_affine(constrained, X, Y, one_loop<3>(X));
        const auto pair = loop_pair(X, Y);
        CHECK((fit.map.A - theta(minimizer_f(pair).A, fit.uX, fit.uY, fit.uX)).norm() < 1e-13);
        CHECK((fit.map.A - minimizer_h(pair, fit.uX, fit.uY).A).norm() < 1e-13);
        const auto planar = fit_affine(constrained, X, flat, one_loop<3>(X));
        const auto algorithm = fit_affine(AffineMethod::h, X, flat, one_loop<3>(X));
        CHECK((planar.map.A - algorithm.map.A).norm() < 1e-12);
    }
}

TEST_CASE("Exact on the loop for every motion of any loop, and for Y = T X with T nX = nY") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.multi_loop(16, 0.5);
        const auto offsets = Random::offsets(16);
        const Eigen::Matrix3d Q = random.orthogonal<3>();
        const Points<3> moved = (Q * X).colwise() + random.vector<3>();
        const auto rigid = fit_affine(constrained, X, moved, offsets);
        CHECK(rigid.residual < 1e-14);
        CHECK((rigid.map.A - Q).norm() < 1e-14);
        const Eigen::Vector3d n = pseudo_normal(X, offsets).normal;
        Eigen::Matrix3d T = random.linear<3>();
        T = (T - n * (n.transpose() * T)).eval();
        T += (Q * n - T * n) * n.transpose();
        T = Eigen::Matrix3d(n * n.transpose() + (Eigen::Matrix3d::Identity() - n * n.transpose()) * T *
                                                    (Eigen::Matrix3d::Identity() - n * n.transpose()));
        const Points<3> stretched = T * X;
        const auto fit = fit_affine(constrained, X, stretched, offsets);
        const bool kept = (T * n - pseudo_normal(stretched, offsets).normal).norm() < 1e-12;
        CHECK((fit.residual < 1e-13) == kept);
    }
}

TEST_CASE("Noise eps on the loops moves no node by more than 2 eps, for eps from 1e-16 to 1e-1") {
    using Noise = test::NoiseSetup::Noise;
    const double rounding = 2e-15;
    for (const auto kind : {Noise::off_the_source_plane, Noise::cad_like, Noise::everywhere}) {
        for (const double misfit : {0.0, 1e-2}) {
            for (int exponent = -16; exponent <= -1; ++exponent) {
                const double eps = std::pow(10.0, exponent);
                INFO("kind " << static_cast<int>(kind) << ", misfit " << misfit << ", eps " << eps);
                const double moved = test::worst_movement(constrained, kind, misfit, eps);
                CHECK(moved <= 2 * eps + rounding);
                CHECK(moved > 0);
            }
        }
    }
}

TEST_CASE("A section of 1e6 : 1 may become one of 1 : 1e6") {
    Random random(3);
    const Points<3> X = random.loop(20, 0);
    Points<3> thin = X;
    thin.row(0) *= 1e6;
    Points<3> tall = X;
    tall.row(1) *= 1e6;
    const auto fit = fit_affine(constrained, thin, tall, one_loop<3>(X));
    REQUIRE(fit.status == FitStatus::ok);
    CHECK(fit.residual < 1e-8);
    CHECK((fit.uX - Eigen::Vector3d::UnitZ()).norm() < 1e-12);
}

TEST_CASE("What has no constrained map says why") {
    Random random(2);
    const Points<3> X = random.loop(12, 0.2);
    const Offsets loop = one_loop<3>(X);
    Points<3> line = X;
    line.row(1) = 2 * line.row(0);
    line.row(2) = -line.row(0);
    Points<3> eight = X;
    Points<3> twice = X;
    for (Eigen::Index i = 0; i < 12; ++i) {
        const double t = 2 * M_PI * static_cast<double>(i) / 12;
        eight.col(i) << std::sin(t), std::sin(2 * t), 0;
        twice.col(i) << std::cos(5 * t), std::sin(5 * t), 0;
    }
    Points<3> circle = X;
    for (Eigen::Index i = 0; i < 12; ++i) {
        const double t = 2 * M_PI * static_cast<double>(i) / 12;
        circle.col(i) << std::cos(t), std::sin(t), 0;
    }
    const Eigen::Matrix3d Q = random.orthogonal<3>();
    for (const double offset : {0.0, 1e6}) {
        INFO("offset " << offset);
        const auto placed = [&](const Points<3>& points) { return Points<3>((Q * points).array() + offset); };
        const auto source = fit_affine(constrained, placed(line), placed(X), loop);
        CHECK(source.status == FitStatus::source_degenerate);
        CHECK(source.map.A.array().isNaN().all());
        const auto target = fit_affine(constrained, placed(X), placed(line), loop);
        CHECK(target.status == FitStatus::target_degenerate);
        CHECK(target.at_target);
        const auto null_source = fit_affine(constrained, placed(eight), placed(X), loop);
        CHECK(null_source.status == FitStatus::null_pseudo_area);
        CHECK_FALSE(null_source.at_target);
        const auto null_target = fit_affine(constrained, placed(X), placed(eight), loop);
        CHECK(null_target.status == FitStatus::null_pseudo_area);
        CHECK(null_target.at_target);
        CHECK(fit_affine(constrained, placed(circle), placed(twice), loop).status == FitStatus::unrelated_loops);
        CHECK(fit_affine(constrained, placed(circle), placed(circle), loop).status == FitStatus::ok);
    }
    const Points<4> full = random.points<4>(12);
    CHECK(fit_affine(constrained, full, full, one_loop<4>(full)).status == FitStatus::null_pseudo_area);
}
