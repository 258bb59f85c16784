#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/functionals.hpp>
#include <pavior/affine/theta.hpp>
#include <pavior/core/error.hpp>

using pavior::theta;

TEST_CASE("Lemma 2.8: Theta equals A on the hyperplane and takes uX to uY") {
    test::for_dimensions_and_seeds(25, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        test::Random random(seed);
        const Vector normal = random.unit<N>();
        const Vector uX = normal + 0.5 * random.vector<N>().normalized();
        const Vector uY = random.vector<N>();
        const Eigen::Matrix<double, N, N> A = random.matrix<N, N>();
        const auto T = theta(A, uX, uY, normal);
        CHECK((T * uX - uY).norm() < 1e-13);
        Vector v = random.vector<N>();
        v -= normal * normal.dot(v);
        CHECK((T * v - A * v).norm() < 1e-13);
    });
}

TEST_CASE("Lemmas A.4 to A.6: on a hyperplanar set Theta leaves F, and G and H equal it") {
    test::for_dimensions_and_seeds(25, [](auto n, int seed) {
        constexpr int N = n;
        INFO("n = " << N << ", seed " << seed);
        using Vector = Eigen::Matrix<double, N, 1>;
        test::Random random(seed);
        const Vector normal = random.unit<N>();
        const auto X = random.hyperplanar<N>(3 * N, normal, random.vector<N>());
        const test::Points<N> Y = random.points<N>(3 * N).colwise() + 4 * normal;
        const Eigen::Matrix<double, N, N> A = random.matrix<N, N>();
        const Vector uX = normal + 0.5 * random.vector<N>().normalized();
        const Vector uY = random.vector<N>();
        const Vector d = Y.rowwise().mean() - X.rowwise().mean();
        const double F = pavior::functional_f(A, X, Y);
        CHECK(pavior::functional_f(theta(A, uX, uY, normal), X, Y) == Approx(F));
        CHECK(pavior::functional_h(theta(A, uX, uY, normal), uX, uY, X, Y) == Approx(F));
        CHECK(pavior::functional_f(theta(A, d, d, normal), X, Y) == Approx(F));
        CHECK(pavior::functional_g(theta(A, d, d, normal), X, Y) == Approx(F));
    });
}

TEST_CASE("Theta refuses a direction in the hyperplane") {
    const Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    CHECK_THROWS_AS(theta(A, x, z, z), pavior::InputError);
    CHECK_NOTHROW(theta(A, Eigen::Vector3d(x + 1e-6 * z), z, z));
}
