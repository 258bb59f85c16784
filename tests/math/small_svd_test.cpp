#include "support/catch.hpp"

#include <pavior/math/small_svd.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

template <class Matrix>
Matrix random_matrix(std::mt19937_64& engine, Eigen::Index rows, Eigen::Index cols) {
    using Scalar = typename Matrix::Scalar;
    return Matrix::NullaryExpr(
        rows, cols, [&] { return static_cast<Scalar>(static_cast<double>(engine() >> 11U) / 4503599627370496.0 - 1); });
}

template <class Scalar, int R, int C>
void check_decomposition(const Eigen::Matrix<Scalar, R, C>& M, Scalar tolerance) {
    const auto svd = pavior::small_svd(M);
    const Scalar scale = std::max(M.norm(), std::numeric_limits<Scalar>::min());
    const auto identity = Eigen::Matrix<Scalar, C, C>::Identity(M.cols(), M.cols());
    CHECK((svd.U * svd.w.asDiagonal() * svd.V.transpose() - M).norm() <= tolerance * scale);
    CHECK((svd.U.transpose() * svd.U - identity).norm() <= tolerance);
    CHECK((svd.V.transpose() * svd.V - identity).norm() <= tolerance);
    for (Eigen::Index i = 0; i < svd.w.size(); ++i) {
        CHECK(svd.w(i) >= 0);
        CHECK((i == 0 || svd.w(i) <= svd.w(i - 1)));
    }
}

template <class Scalar, int R, int C>
void check_size(Eigen::Index rows, Eigen::Index cols) {
    std::mt19937_64 engine(17);
    const Scalar tolerance = 20 * std::numeric_limits<Scalar>::epsilon() * static_cast<Scalar>(rows);
    using Matrix = Eigen::Matrix<Scalar, R, C>;
    for (int repeat = 0; repeat < 50; ++repeat) {
        INFO("repeat " << repeat << ", size " << rows << " x " << cols);
        Matrix M = random_matrix<Matrix>(engine, rows, cols);
        check_decomposition<Scalar, R, C>(M, tolerance);
        M.col(0) = M.col(cols - 1) * Scalar(2);
        check_decomposition<Scalar, R, C>(M, tolerance);
        CHECK(pavior::small_svd(M).rank(tolerance * M.norm()) == std::max<Eigen::Index>(1, cols - 1));
        M.row(0) *= Scalar(1e-6);
        M.col(cols - 1) *= Scalar(1e-5);
        check_decomposition<Scalar, R, C>(M, tolerance);
    }
    check_decomposition<Scalar, R, C>(Matrix::Zero(rows, cols), tolerance);
    check_decomposition<Scalar, R, C>(Matrix::Identity(rows, cols), tolerance);
}

}  // namespace

TEST_CASE("U, w and V reproduce the matrix and are orthogonal, for regular, singular, graded and zero matrices") {
    check_size<double, 3, 3>(3, 3);
    check_size<double, 6, 3>(6, 3);
    check_size<double, 9, 4>(9, 4);
    check_size<float, 6, 3>(6, 3);
    check_size<float, 2, 2>(2, 2);
    check_size<double, Eigen::Dynamic, Eigen::Dynamic>(24, 12);
    check_size<double, 4, 2>(4, 2);
}

TEST_CASE("Known singular values, to rounding even where they are graded") {
    const double c = std::cos(0.3);
    const double s = std::sin(0.3);
    Eigen::Matrix2d turn;
    turn << c, -s, s, c;
    const Eigen::Matrix2d M = turn * Eigen::Vector2d(3, 0.5).asDiagonal() * turn;
    CHECK(pavior::small_svd(M).w(0) == Approx(3).epsilon(1e-15));
    CHECK(pavior::small_svd(M).w(1) == Approx(0.5).epsilon(1e-14));
    const Eigen::Matrix2d graded = turn * Eigen::Vector2d(1, 1e-13).asDiagonal();
    CHECK(pavior::small_svd(graded).w(1) == Approx(1e-13).epsilon(1e-14));
}

TEST_CASE("solve is the least-squares solution of smallest norm") {
    std::mt19937_64 engine(5);
    using Tall = Eigen::Matrix<double, 6, 3>;
    Tall M = random_matrix<Tall>(engine, 6, 3);
    const Eigen::Matrix<double, 2, 6> B = random_matrix<Eigen::Matrix<double, 2, 6>>(engine, 2, 6);
    const auto regular = pavior::small_svd(M).solve(B, 1e-12);
    CHECK(((B - regular * M.transpose()) * M).norm() < 1e-14);
    M.col(2) = M.col(0) + M.col(1);
    const auto svd = pavior::small_svd(M);
    const auto singular = svd.solve(B, 1e-12);
    CHECK(((B - singular * M.transpose()) * M).norm() < 1e-14);
    CHECK((singular * svd.V.col(2)).norm() < 1e-14);
    CHECK(std::abs(svd.V.col(2).dot(Eigen::Vector3d(1, 1, -1).normalized())) == Approx(1).epsilon(1e-14));
}

TEST_CASE("NaN ends quickly and stays NaN") {
    Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
    M(1, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(pavior::small_svd(M).w.sum()));
}
