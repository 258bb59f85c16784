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
template <class Scalar, int N>
[[nodiscard]] Scalar functional_e(const Eigen::Matrix<Scalar, N, N>& A, const Eigen::Matrix<Scalar, N, 1>& b,
                                  PointsRef<Scalar, N> X, PointsRef<Scalar, N> Y) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    const auto source = centring<Scalar, N>(X);
    const auto target = centring<Scalar, N>(Y);
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
template <class Scalar, int N>
[[nodiscard]] Scalar functional_h(const Eigen::Matrix<Scalar, N, N>& A, const Eigen::Matrix<Scalar, N, 1>& uX,
                                  const Eigen::Matrix<Scalar, N, 1>& uY, PointsRef<Scalar, N> X,
                                  PointsRef<Scalar, N> Y) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    const auto source = centring<Scalar, N>(X);
    const auto target = centring<Scalar, N>(Y);
    Scalar sum = Vector(uY - A * uX).squaredNorm();
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error = target.scale * target.local(Y.col(i)) - A * (source.scale * source.local(X.col(i)));
        sum += error.squaredNorm();
    }
    return sum;
}

/// F(A) = sum |y_i - cY - A (x_i - cX)|^2 = H(A; 0, 0).
template <class Scalar, int N>
[[nodiscard]] Scalar functional_f(const Eigen::Matrix<Scalar, N, N>& A, PointsRef<Scalar, N> X,
                                  PointsRef<Scalar, N> Y) {
    const Eigen::Matrix<Scalar, N, 1> zero = Eigen::Matrix<Scalar, N, 1>::Zero(X.rows());
    return functional_h<Scalar, N>(A, zero, zero, X, Y);
}

/// G(A) = sum |y_i - cX - A (x_i - cX + cY - cX)|^2.
template <class Scalar, int N>
[[nodiscard]] Scalar functional_g(const Eigen::Matrix<Scalar, N, N>& A, PointsRef<Scalar, N> X,
                                  PointsRef<Scalar, N> Y) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    const auto source = centring<Scalar, N>(X);
    const auto target = centring<Scalar, N>(Y);
    const Vector d = (target.centre - source.centre) + (target.scale * target.shift - source.scale * source.shift);
    Scalar sum = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error =
            target.scale * target.local(Y.col(i)) + d - A * (source.scale * source.local(X.col(i)) + d);
        sum += error.squaredNorm();
    }
    return sum;
}

/// The same for any matrix expressions; n is that of X.
template <class DerivedA, class DerivedB, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_e(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedB>& b,
                                const Eigen::MatrixBase<DerivedX>& X, const Eigen::MatrixBase<DerivedY>& Y) {
    return functional_e<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime>(A.derived(), b.derived(), X.derived(),
                                                                                Y.derived());
}
template <class DerivedA, class DerivedU, class DerivedV, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_h(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedU>& uX,
                                const Eigen::MatrixBase<DerivedV>& uY, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    return functional_h<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime>(A.derived(), uX.derived(), uY.derived(),
                                                                                X.derived(), Y.derived());
}
template <class DerivedA, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_f(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    return functional_f<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime>(A.derived(), X.derived(), Y.derived());
}
template <class DerivedA, class DerivedX, class DerivedY>
[[nodiscard]] auto functional_g(const Eigen::MatrixBase<DerivedA>& A, const Eigen::MatrixBase<DerivedX>& X,
                                const Eigen::MatrixBase<DerivedY>& Y) {
    return functional_g<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime>(A.derived(), X.derived(), Y.derived());
}

/// \cond
#define PAVIOR_FUNCTIONALS(prefix, Scalar, N)                                                                       \
    prefix template Scalar functional_e<Scalar, N>(const Eigen::Matrix<Scalar, N, N>&,                              \
                                                   const Eigen::Matrix<Scalar, N, 1>&, PointsRef<Scalar, N>,        \
                                                   PointsRef<Scalar, N>);                                           \
    prefix template Scalar functional_h<Scalar, N>(                                                                 \
        const Eigen::Matrix<Scalar, N, N>&, const Eigen::Matrix<Scalar, N, 1>&, const Eigen::Matrix<Scalar, N, 1>&, \
        PointsRef<Scalar, N>, PointsRef<Scalar, N>);                                                                \
    prefix template Scalar functional_f<Scalar, N>(const Eigen::Matrix<Scalar, N, N>&, PointsRef<Scalar, N>,        \
                                                   PointsRef<Scalar, N>);                                           \
    prefix template Scalar functional_g<Scalar, N>(const Eigen::Matrix<Scalar, N, N>&, PointsRef<Scalar, N>,        \
                                                   PointsRef<Scalar, N>);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_FUNCTIONALS, extern)
#endif
/// \endcond

}  // namespace pavior
