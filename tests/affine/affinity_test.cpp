#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/affinity.hpp>
#include <pavior/affine/functionals.hpp>

#include <limits>

using namespace pavior;
using test::Points;
using test::Random;

TEST_CASE("Propositions 2.25 to 2.27: exact affine maps are the zeros of F, G and H") {
    test::for_dimensions_and_seeds(25, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        Random random(seed);
        const Vector normal = random.unit<N>();
        const Eigen::Matrix<double, N, N> T = random.linear<N>();
        const Points<N> full = random.points<N>(5 * N);
        const Points<N> flat = random.hyperplanar<N>(5 * N, normal, random.vector<N>());
        for (const auto& X : {full, flat}) {
            const bool hyperplanar = minimizer_f(loop_pair(X, X)).rank < N;
            const Vector shift = 4 * normal + random.vector<N>() - T * X.rowwise().mean();
            const Points<N> Y = (T * X).colwise() + shift;
            Points<N> bent = Y;
            bent(0, 0) += 0.1;
            const Vector uX = random.vector<N>();
            const Vector uY = T * uX;
            for (const bool exact : {true, false}) {
                INFO("exact " << exact << ", hyperplanar " << hyperplanar);
                const Points<N>& target = exact ? Y : bent;
                const auto pair = loop_pair(X, target);
                const double zero = 1e-24;
                CHECK(are_affine(X, target) == exact);
                CHECK((functional_f(minimizer_f(pair).A, X, target) < zero) == exact);
                CHECK((functional_h(minimizer_h(pair, uX, uY).A, uX, uY, X, target) < zero) == exact);
                if (hyperplanar) {
                    CHECK((functional_g(minimizer_g(pair).A, X, target) < zero) == exact);
                }
            }
        }
    });
}

TEST_CASE("Exactness survives offsets, scales and sections that change their shape") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.loop(20, 0.3);
        const Eigen::Matrix3d T = random.linear<3>();
        for (const double scale : {1e-200, 1e-6, 1.0, 1e6, 1e200}) {
            CHECK(are_affine(X, T * X * scale));
            CHECK(are_affine(X * scale, T * X));
        }
        CHECK(are_affine(((X).array() + 1e7).matrix(), ((T * X).array() - 3e6).matrix()));
        const Eigen::Matrix3d thin = random.orthogonal<3>() * Eigen::Vector3d(1e6, 1, 1).asDiagonal();
        const Eigen::Matrix3d tall = random.orthogonal<3>() * Eigen::Vector3d(1, 1e6, 1).asDiagonal();
        CHECK(are_affine(thin * X, tall * X));
        Points<3> bent = X;
        bent(0, 0) += 1e-9;
        CHECK_FALSE(are_affine(X, bent));
        CHECK(are_affine(X, bent, 1e-8));
        CHECK(are_affine(X.cast<float>(), (T * X).cast<float>()));
        bent(0, 0) += 1e-3;
        CHECK_FALSE(are_affine(X.cast<float>(), bent.cast<float>()));
    }
}

TEST_CASE("The defect is relative to the target and at most one") {
    Random random(2);
    const Points<3> X = random.loop(20, 0.3);
    const Points<3> Y = random.points<3>(20);
    const double defect = affinity(loop_pair(X, Y)).defect;
    CHECK(defect > 0.1);
    CHECK(defect <= 1);
    CHECK(affinity(loop_pair(X, Points<3>(1e9 * Y))).defect == Approx(defect).epsilon(1e-12));
    const Points<3> point = Eigen::Vector3d(1, 2, 3).replicate(1, 20);
    CHECK(are_affine(X, point));
    CHECK_FALSE(are_affine(point, X));
    Points<3> bad = X;
    bad(1, 1) = std::numeric_limits<double>::infinity();
    CHECK_FALSE(are_affine(bad, X));
}
