#include "support/catch.hpp"

#include <pavior/math/streamed_qr.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace {

template <class Scalar, int K>
void check_factor(Eigen::Index rows, Eigen::Index columns) {
    INFO(rows << " rows, " << columns << " columns");
    std::mt19937_64 engine(11);
    using Tall = Eigen::Matrix<Scalar, Eigen::Dynamic, K>;
    const Tall M = Tall::NullaryExpr(rows, columns, [&] {
        return static_cast<Scalar>(static_cast<double>(engine() >> 11U) / 4503599627370496.0 - 1);
    });
    pavior::StreamedQr<Scalar, K> qr(columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
        qr.add(M.row(i));
    }
    const auto R = qr.factor();
    const Scalar tolerance = 20 * std::numeric_limits<Scalar>::epsilon() * static_cast<Scalar>(rows);
    CHECK((R.transpose() * R - M.transpose() * M).norm() <= tolerance);
    for (Eigen::Index i = 0; i < columns; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            CHECK(R(i, j) == Scalar(0));
        }
    }
}

}  // namespace

TEST_CASE("The factor keeps the inner products, below, at and above the size of a block") {
    for (const Eigen::Index rows : {1, 3, 6, 63, 64, 65, 128, 1000}) {
        check_factor<double, 6>(rows, 6);
        check_factor<double, 4>(rows, 4);
        check_factor<float, 6>(rows, 6);
        check_factor<double, Eigen::Dynamic>(rows, 10);
    }
}

TEST_CASE("Small singular values survive: the condition number is not squared") {
    const double thickness = 1e-12;
    pavior::StreamedQr<double, 2> qr;
    for (int i = 0; i < 500; ++i) {
        const double t = 0.01 * i - 2.5;
        qr.add(Eigen::RowVector2d(t, t + (i % 2 == 0 ? thickness : -thickness)));
    }
    const Eigen::Matrix2d R = qr.factor();
    // |det R| = |first column| * |part of the second one perpendicular to it|
    CHECK(std::abs(R(1, 1)) == Approx(thickness * std::sqrt(500.0)).epsilon(1e-3));
}

TEST_CASE("Rows may be added after the factor was read; without rows it is zero") {
    pavior::StreamedQr<double, 3> qr;
    CHECK(qr.factor() == Eigen::Matrix3d::Zero());
    qr.add(Eigen::RowVector3d(3, 0, 0));
    CHECK(std::abs(qr.factor()(0, 0)) == Approx(3));
    qr.add(Eigen::RowVector3d(4, 0, 0));
    CHECK(std::abs(qr.factor()(0, 0)) == Approx(5));
}
