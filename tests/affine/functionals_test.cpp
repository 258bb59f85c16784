#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/functionals.hpp>

using namespace pavior;

TEST_CASE("Lemma A.3: E, F, G and H are one functional at different points") {
    test::for_dimensions_and_seeds(25, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        test::Random random(seed);
        const auto X = random.points<N>(4 * N);
        const auto Y = random.points<N>(4 * N);
        const Vector cX = X.rowwise().mean();
        const Vector cY = Y.rowwise().mean();
        const Eigen::Matrix<double, N, N> A = random.matrix<N, N>();
        const Vector uX = random.vector<N>();
        const Vector Au = A * uX;
        CHECK(functional_e(A, cY, X, Y) == Approx(functional_f(A, X, Y)).epsilon(1e-13));
        CHECK(functional_e(A, Vector(cX + A * (cY - cX)), X, Y) == Approx(functional_g(A, X, Y)).epsilon(1e-13));
        CHECK(functional_e(A, cY, X, Y) == Approx(functional_h(A, uX, Au, X, Y)).epsilon(1e-13));
    });
}

TEST_CASE("The functionals against their definitions") {
    test::for_dimensions_and_seeds(10, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        test::Random random(seed);
        const auto X = random.points<N>(7);
        const auto Y = random.points<N>(7);
        const Vector cX = X.rowwise().mean();
        const Vector cY = Y.rowwise().mean();
        const Eigen::Matrix<double, N, N> A = random.matrix<N, N>();
        const Vector b = random.vector<N>();
        const Vector u = random.vector<N>();
        double E = 0;
        double F = 0;
        double G = 0;
        for (int i = 0; i < 7; ++i) {
            const Vector x = X.col(i);
            const Vector y = Y.col(i);
            E += Vector(y - A * (x - cX) - b).squaredNorm();
            F += Vector(y - cY - A * (x - cX)).squaredNorm();
            G += Vector(y - cX - A * (x - cX + cY - cX)).squaredNorm();
        }
        CHECK(functional_e(A, b, X, Y) == Approx(E).epsilon(1e-13));
        CHECK(functional_f(A, X, Y) == Approx(F).epsilon(1e-13));
        CHECK(functional_g(A, X, Y) == Approx(G).epsilon(1e-13));
        CHECK(functional_h(A, b, u, X, Y) == Approx(F + (u - A * b).squaredNorm()).epsilon(1e-13));
    });
}

TEST_CASE("F keeps its digits far from the origin") {
    test::Points<2> X(2, 4);
    X << 0, 1, 1, 0, 0, 0, 1, 1;
    test::Points<2> Y = X;
    Y.col(0) *= 2;
    Y.col(1) *= 2;
    const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
    const double near = functional_f(identity, X, Y);
    X.array() += 1e9;
    Y.array() -= 1e9;
    CHECK(near == Approx(0.75).epsilon(1e-15));
    CHECK(functional_f(identity, X, Y) == Approx(near).epsilon(1e-15));
}
