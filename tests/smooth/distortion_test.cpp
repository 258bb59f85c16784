#include <pavior/smooth/distortion.hpp>

#include "smooth/meshes.hpp"
#include "support/catch.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

using namespace pavior;
using pavior_test::Random;

namespace {

template <int D>
Eigen::Matrix<double, D, D> random_matrix(Random& random) {
    Eigen::Matrix<double, D, D> J;
    for (Eigen::Index k = 0; k < D * D; ++k) {
        J(k) = random(-2.0, 2.0);
    }
    return J;
}

template <int D>
void check_derivative() {
    Random random(D);
    for (int trial = 0; trial < 200; ++trial) {
        const double epsilon = std::pow(10.0, random(-2.0, 1.0));
        const Eigen::Matrix<double, D, D> J = random_matrix<D>(random);
        Eigen::Matrix<double, D, D> slope;
        Eigen::Matrix<double, D, D> unused;
        const Distortion at = distortion<D>(J, epsilon, 0.7, slope);
        CHECK(at.det == Approx(J.determinant()).margin(1e-12));
        CHECK(at.shape_curvature > 0.0);
        CHECK(at.det_curvature > 0.0);
        for (Eigen::Index k = 0; k < D * D; ++k) {
            Eigen::Matrix<double, D, D> plus = J;
            Eigen::Matrix<double, D, D> minus = J;
            const double h = 1e-6 * std::min(1.0, epsilon);
            plus(k) += h;
            minus(k) -= h;
            const double difference =
                (distortion<D>(plus, epsilon, 0.7, unused).value - distortion<D>(minus, epsilon, 0.7, unused).value) /
                (2.0 * h);
            CHECK(slope(k) == Approx(difference).epsilon(1e-4).margin(1e-5 * at.value));
        }
    }
}

}  // namespace

TEST_CASE("chi is positive, smooth and next to det or epsilon^2 / (4 |det|)", "[distortion]") {
    CHECK(foldover_chi(0.0, 2.5) == 2.5);
    CHECK(foldover_chi(1.0, 0.0) == 0.5);
    CHECK(foldover_chi(1e-8, -1.0) == Approx(0.25e-16).epsilon(1e-6));
    CHECK(foldover_chi(1e-8, 1.0) == Approx(1.0));
    CHECK(foldover_chi(1e-8, -1e8) > 0.0);
    CHECK(foldover_chi(0.1, 0.3) - foldover_chi(0.1, -0.3) == Approx(0.3));
}

TEST_CASE("the distortion of a rotation is 1, of anything else more", "[distortion]") {
    Random random(1);
    Eigen::Matrix2d slope2;
    Eigen::Matrix3d slope3;
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    CHECK(distortion<2>(turn, 0.0, 0.5, slope2).value == Approx(1.0).epsilon(1e-14));
    CHECK(slope2.norm() < 1e-14);
    const Eigen::Matrix3d roll = Eigen::AngleAxisd(0.9, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    CHECK(distortion<3>(roll, 0.0, 0.5, slope3).value == Approx(1.0).epsilon(1e-14));
    CHECK(slope3.norm() < 1e-14);
    for (int trial = 0; trial < 100; ++trial) {
        const Eigen::Matrix3d J = random_matrix<3>(random);
        if (J.determinant() > 0.0) {
            CHECK(distortion<3>(J, 0.0, 0.5, slope3).value > 1.0);
        }
    }
}

TEST_CASE("the derivative of the distortion is that of its value", "[distortion]") {
    check_derivative<2>();
    check_derivative<3>();
}

TEST_CASE("cofactors are the derivative of the determinant", "[distortion]") {
    Random random(4);
    const Eigen::Matrix3d J = random_matrix<3>(random);
    CHECK((cofactors<3>(J) - J.determinant() * J.inverse().transpose()).norm() < 1e-12);
    const Eigen::Matrix2d K = random_matrix<2>(random);
    CHECK((cofactors<2>(K) - K.determinant() * K.inverse().transpose()).norm() < 1e-12);
}
