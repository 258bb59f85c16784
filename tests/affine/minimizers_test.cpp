#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/functionals.hpp>
#include <pavior/affine/minimizers.hpp>
#include <pavior/affine/theta.hpp>

#include <Eigen/Core>

#include <cmath>
#include <utility>

using namespace pavior;
using test::Points;
using test::Random;

namespace {

constexpr int seeds = 25;

template <int N>
auto pair_of(const Points<N>& X, const Points<N>& Y) {
    return loop_pair(X, Y);
}

/// A hyperplanar X, a general Y, and the normal of X.
template <int N>
struct HyperplanarCase {
    using Vector = Eigen::Matrix<double, N, 1>;
    using Matrix = Eigen::Matrix<double, N, N>;
    Random random;
    Vector normal;
    Points<N> X;
    Points<N> Y;

    explicit HyperplanarCase(int seed, Eigen::Index m = 4 * N)
        : random(seed),
          normal(random.unit<N>()),
          X(random.hyperplanar<N>(m, normal, random.vector<N>())),
          Y(random.points<N>(m)) {
        Y.colwise() += Vector(3 * normal + random.vector<N>());
    }
};

}  // namespace

TEST_CASE("Proposition 2.2: b^E is the centre of Y, against the full system with n^2 + n unknowns") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        Random random(seed);
        const Points<N> X = random.points<N>(5 * N);
        const Points<N> Y = random.points<N>(5 * N);
        Eigen::MatrixXd system(X.cols(), N + 1);
        system << X.transpose(), Eigen::VectorXd::Ones(X.cols());
        const Eigen::MatrixXd solution = test::least_squares(system, Y.transpose());
        const AffineMap<double, N> E = minimizer_e(pair_of<N>(X, Y));
        CHECK((E.A - solution.topRows(N).transpose()).norm() < 1e-12);
        CHECK((E.offset() - solution.row(N).transpose()).norm() < 1e-12);
        CHECK((E(X.rowwise().mean()) - Y.rowwise().mean()).norm() < 1e-13);
    });
}

TEST_CASE("Proposition 2.11 and Remark 2.12: F has rank n - 1 on hyperplanar sets and n otherwise") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        const auto flat = minimizer_f(pair_of<N>(c.X, c.Y));
        CHECK(flat.rank == N - 1);
        CHECK_FALSE(flat.unique());
        CHECK((flat.A * c.normal).norm() < 1e-13);
        const auto full = minimizer_f(pair_of<N>(c.Y, c.X));
        CHECK(full.rank == N);
        CHECK(full.unique());
    });
}

TEST_CASE("Proposition 2.13: G has rank n unless cY - cX lies in the hyperplane") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        CHECK(minimizer_g(pair_of<N>(c.X, c.Y)).rank == N);
        const Eigen::Matrix<double, N, 1> d = c.Y.rowwise().mean() - c.X.rowwise().mean();
        const Points<N> inside = c.Y.colwise() - c.normal * c.normal.dot(d);
        CHECK(minimizer_g(pair_of<N>(c.X, inside)).rank == N - 1);
    });
}

TEST_CASE("Proposition 2.15: H has rank n unless uX lies in the hyperplane") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        const Vector uY = c.random.template vector<N>();
        const Vector inside = c.X.col(0) - c.X.col(1);
        const auto pair = pair_of<N>(c.X, c.Y);
        CHECK(minimizer_h(pair, inside, uY).rank == N - 1);
        CHECK(minimizer_h(pair, Vector(inside + 0.1 * c.normal), uY).rank == N);
        CHECK(minimizer_h(pair, Vector(Vector::Zero()), uY).rank == N - 1);
    });
}

TEST_CASE("Proposition 2.17: E and F have the same minimum and minimisers") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        for (const auto& [X, Y] : {std::pair{c.X, c.Y}, std::pair{c.Y, c.X}}) {
            const Eigen::Matrix<double, N, 1> cY = Y.rowwise().mean();
            const auto E = minimizer_e(pair_of<N>(X, Y));
            const auto AF = minimizer_f(pair_of<N>(X, Y)).A;
            const double minimum = functional_f(AF, X, Y);
            CHECK(functional_e(E.A, E(X.rowwise().mean()), X, Y) == Approx(minimum));
            CHECK(functional_e(AF, cY, X, Y) == Approx(functional_e(E.A, cY, X, Y)));
            CHECK(functional_f(E.A, X, Y) == Approx(minimum));
            const auto noise = [&] { return Eigen::Matrix<double, N, N>(0.1 * c.random.template matrix<N, N>()); };
            const Eigen::Matrix<double, N, 1> shift = 0.1 * c.random.template vector<N>();
            CHECK(functional_f(AF + noise(), X, Y) > minimum);
            CHECK(functional_e(AF + noise(), cY + shift, X, Y) > minimum);
        }
    });
}

TEST_CASE("Proposition 2.19: A^G is Theta of A^F along cY - cX") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        const auto pair = pair_of<N>(c.X, c.Y);
        const Eigen::Matrix<double, N, 1> d = c.Y.rowwise().mean() - c.X.rowwise().mean();
        const auto AF = minimizer_f(pair).A;
        const auto G = minimizer_g(pair);
        CHECK(G.unique());
        CHECK(functional_g(G.A, c.X, c.Y) == Approx(functional_f(AF, c.X, c.Y)));
        CHECK((G.A - theta(AF, d, d, c.normal)).norm() < 1e-11);
        CHECK(functional_f(G.A, c.X, c.Y) == Approx(functional_f(AF, c.X, c.Y)));
        CHECK((G.A * d - d).norm() < 1e-11);
    });
}

TEST_CASE("A^G solves its own overdetermined system for any sets") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        Random random(seed);
        const Points<N> X = random.points<N>(5 * N);
        const Points<N> Y = random.points<N>(5 * N).colwise() + random.unit<N>();
        const Eigen::Matrix<double, N, 1> cX = X.rowwise().mean();
        const Eigen::Matrix<double, N, 1> cY = Y.rowwise().mean();
        const Eigen::MatrixXd left = (X.colwise() + (cY - 2 * cX)).transpose();
        const Eigen::MatrixXd right = (Y.colwise() - cX).transpose();
        const Eigen::MatrixXd A = test::least_squares(left, right).transpose();
        CHECK((minimizer_g(pair_of<N>(X, Y)).A - A).norm() < 1e-12);
    });
}

TEST_CASE("Proposition 2.21: on hyperplanar sets A^H is Theta of A^F") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        const Vector uX = c.normal + 0.3 * c.random.template vector<N>();
        const Vector uY = c.random.template vector<N>();
        const auto pair = pair_of<N>(c.X, c.Y);
        const auto AF = minimizer_f(pair).A;
        const auto H = minimizer_h(pair, uX, uY);
        const double minimum = functional_f(AF, c.X, c.Y);
        CHECK(H.unique());
        CHECK(functional_h(H.A, uX, uY, c.X, c.Y) == Approx(minimum));
        CHECK((H.A - theta(AF, uX, uY, c.normal)).norm() < 1e-11);
        CHECK(functional_f(H.A, c.X, c.Y) == Approx(minimum));
        CHECK((H.A * uX - uY).norm() < 1e-11);
        CHECK(functional_h(H.A + 0.1 * c.random.template matrix<N, N>(), uX, uY, c.X, c.Y) > minimum);
    });
}

TEST_CASE("Proposition 2.23: with uX = 0, F and H have the same minimiser") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        Random random(seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        const Points<N> X = random.points<N>(5 * N);
        const Points<N> Y = random.points<N>(5 * N);
        const Vector zero = Vector::Zero();
        const Vector uY = random.vector<N>();
        const auto AF = minimizer_f(pair_of<N>(X, Y)).A;
        const auto AH = minimizer_h(pair_of<N>(X, Y), zero, uY).A;
        CHECK(functional_f(AF, X, Y) == Approx(functional_h(AH, zero, uY, X, Y) - uY.squaredNorm()));
        CHECK(functional_f(AH, X, Y) == Approx(functional_f(AF, X, Y)));
    });
}

TEST_CASE("The coplanar circle and ellipse of Section 2.4") {
    const auto data = test::read_case("h16_coplanar_matrices");
    const double tolerance = data["tol_abs"];
    const Points<3> X = test::to_points(data["X"]);
    const Points<3> Y = test::to_points(data["Y"]);
    const Eigen::Vector3d u = Eigen::Vector3d::UnitZ();
    const auto& expected = data["expected"];
    const auto pair = loop_pair(X, Y);
    const auto F = minimizer_f(pair);
    const auto G = minimizer_g(pair);
    const auto H = minimizer_h(pair, u, u);
    CHECK((F.A - test::to_points(expected["AF"]).transpose()).cwiseAbs().maxCoeff() <= tolerance);
    CHECK((G.A - test::to_points(expected["AG"]).transpose()).cwiseAbs().maxCoeff() <= tolerance);
    CHECK((H.A - test::to_points(expected["AH"]).transpose()).cwiseAbs().maxCoeff() <= tolerance);
    CHECK(F.rank == expected["rank_F"].get<int>());
    CHECK(G.rank == expected["rank_G"].get<int>());
    CHECK(H.rank == expected["rank_H"].get<int>());
    CHECK(std::abs(functional_f(F.A, X, Y) - expected["F"].get<double>()) <= tolerance);
    CHECK(std::abs(functional_g(G.A, X, Y) - expected["G"].get<double>()) <= tolerance);
    CHECK(std::abs(functional_h(H.A, u, u, X, Y) - expected["H"].get<double>()) <= tolerance);
}

TEST_CASE("The minimiser of F has the smallest norm and is the pseudo-inverse solution") {
    test::for_dimensions_and_seeds(seeds, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        const Eigen::MatrixXd Xbar = c.X.colwise() - c.X.rowwise().mean();
        const Eigen::MatrixXd Ybar = c.Y.colwise() - c.Y.rowwise().mean();
        const Eigen::MatrixXd A = test::least_squares(Xbar.transpose(), Ybar.transpose()).transpose();
        CHECK((minimizer_f(pair_of<N>(c.X, c.Y)).A - A).norm() < 1e-12);
    });
}

TEST_CASE("Dynamic and fixed dimension agree, float follows double") {
    test::for_dimensions_and_seeds(5, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        HyperplanarCase<N> c(seed);
        const Eigen::MatrixXd X = c.X;
        const Eigen::MatrixXd Y = c.Y;
        const auto fixed = minimizer_f(pair_of<N>(c.X, c.Y));
        const auto dynamic = minimizer_f(loop_pair(X, Y));
        CHECK((fixed.A - dynamic.A).norm() < 1e-14);
        CHECK(fixed.rank == dynamic.rank);
        CHECK((minimizer_g(pair_of<N>(c.X, c.Y)).A - minimizer_g(loop_pair(X, Y)).A).norm() < 1e-12);
        if constexpr (N < 4) {
            const Eigen::Matrix<float, N, Eigen::Dynamic> Xf = c.X.template cast<float>();
            const Eigen::Matrix<float, N, Eigen::Dynamic> Yf = c.Y.template cast<float>();
            const auto single = minimizer_f(loop_pair(Xf, Yf));
            CHECK(single.rank == N - 1);
            CHECK((single.A.template cast<double>() - fixed.A).norm() < 2e-5);
        }
    });
}

TEST_CASE("Singular values are those of the centred points in the user's unit") {
    Random random(3);
    const Eigen::Vector3d axes(3e5, 2e5, 0.5);
    Points<3> X(3, 6);  // the ends of three axes, turned and moved
    X.leftCols(3) = random.orthogonal<3>() * axes.asDiagonal();
    X.rightCols(3) = -X.leftCols(3);
    X.colwise() += Eigen::Vector3d(1e5 * random.vector<3>());
    CHECK((minimizer_f(loop_pair(X, X)).w - std::sqrt(2.0) * axes).norm() < 1e-9);
    const Points<3> Y = 1e5 * random.points<3>(30);
    const double size = (Y.colwise() - Y.rowwise().mean()).norm();
    CHECK(minimizer_f(loop_pair(Y, Y)).w.norm() == Approx(size).epsilon(1e-14));
}
