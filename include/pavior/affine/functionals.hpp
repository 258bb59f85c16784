#pragma once
/// \file
/// The functionals E, F, G and H of a pair of point sets; equations (2.5) to (2.9) \cite roca2009.
///
/// X and Y hold the points as columns (n x m each, m >= 1). Values are in the user's unit squared; sums are taken over
/// centred points, so that they are precise far from the origin. O(m) each. They overflow above about 1e150.

#include <pavior/affine/centring.hpp>

#include <Eigen/Core>

namespace pavior {

/// E(A, b) = sum |y_i - A (x_i - cX) - b|^2.
template <class DerivedA, class DerivedB, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_e(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedB>& b,
                                const Eigen::MatrixBase<DerivedX>& X, const Eigen::MatrixBase<DerivedY>& Y) {
    using Scalar = typename DerivedX::Scalar;
    using Vector = Eigen::Matrix<Scalar, DerivedX::RowsAtCompileTime, 1>;
    const auto source = centring(X);
    const auto target = centring(Y);
    const Vector offset = (target.centre - b) + target.scale * target.shift;
    Scalar sum = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error =
            offset + target.scale * target.local(Y.col(i)) - A * (source.scale * source.local(X.col(i)));
        sum += error.squaredNorm();
    }
    return sum;
}

/// H(A; uX, uY) = sum |y_i - cY - A (x_i - cX)|^2 + |uY - A uX|^2.
template <class DerivedA, class DerivedU, class DerivedV, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_h(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedU>& uX,
                                const Eigen::MatrixBase<DerivedV>& uY, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    using Scalar = typename DerivedX::Scalar;
    using Vector = Eigen::Matrix<Scalar, DerivedX::RowsAtCompileTime, 1>;
    const auto source = centring(X);
    const auto target = centring(Y);
    Scalar sum = Vector(uY - A * uX).squaredNorm();
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error = target.scale * target.local(Y.col(i)) - A * (source.scale * source.local(X.col(i)));
        sum += error.squaredNorm();
    }
    return sum;
}

/// F(A) = sum |y_i - cY - A (x_i - cX)|^2 = H(A; 0, 0).
template <class DerivedA, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_f(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    using Vector = Eigen::Matrix<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime, 1>;
    const Vector zero = Vector::Zero(X.rows());
    return functional_h(A, zero, zero, X, Y);
}

/// G(A) = sum |y_i - cX - A (x_i - cX + cY - cX)|^2.
template <class DerivedA, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_g(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    using Scalar = typename DerivedX::Scalar;
    using Vector = Eigen::Matrix<Scalar, DerivedX::RowsAtCompileTime, 1>;
    const auto source = centring(X);
    const auto target = centring(Y);
    const Vector d = (target.centre - source.centre) + (target.scale * target.shift - source.scale * source.shift);
    Scalar sum = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error =
            target.scale * target.local(Y.col(i)) + d - A * (source.scale * source.local(X.col(i)) + d);
        sum += error.squaredNorm();
    }
    return sum;
}

}  // namespace pavior
