#pragma once
/// \file
/// A pair of loops condensed to 4 n^2 numbers from which every affine fit follows.

#include <pavior/affine/centring.hpp>
#include <pavior/affine/fit_result.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/math/streamed_qr.hpp>

#include <Eigen/Core>

namespace pavior {

/// Source and target points, centred, scaled to size 1 and rotated by one orthogonal m x m matrix that leaves 2n rows.
/// Least squares are blind to that rotation: for every A, |Ybar - A Xbar| = sy |Y^T - (sx / sy) A X^T|. No
/// inner products are formed, so singular values keep all their digits.
template <class Scalar, int N>
struct LoopPair {
    static constexpr int rows = N == Eigen::Dynamic ? N : 2 * N;
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    using Matrix = Eigen::Matrix<Scalar, N, N>;
    using Tall = Eigen::Matrix<Scalar, rows, N>;

    Centring<Scalar, N> source;
    Centring<Scalar, N> target;
    Tall X;              ///< 2n x n: the condensed transpose of the local source points
    Tall Y;              ///< 2n x n: the same rotation of the local target points
    Eigen::Index m = 0;  ///< number of points

    [[nodiscard]] Eigen::Index dimension() const { return source.centre.size(); }
    [[nodiscard]] bool finite() const { return source.finite && target.finite; }

    /// sy / sx: turns a linear map of local coordinates into one of the user's.
    [[nodiscard]] Scalar ratio() const { return target.scale / source.scale; }

    /// cY - cX in the user's unit.
    [[nodiscard]] Vector displacement() const {
        return target.centre - source.centre + (target.scale * target.shift - source.scale * source.shift);
    }

    /// The map with linear part \p A (user's units) that takes cX to cY + sy * \p t.
    [[nodiscard]] AffineMap<Scalar, N> map(const Matrix& A, const Vector& t) const {
        return {A, source.centre,
                target.centre + (target.scale * (target.shift + t) - A * (source.scale * source.shift))};
    }
    /// The map with linear part \p A that takes cX to cY.
    [[nodiscard]] AffineMap<Scalar, N> map(const Matrix& A) const { return map(A, Vector::Zero(dimension())); }
};

namespace detail {

/// \throws InputError empty_input (no points, or n < 2), size_mismatch
PAVIOR_INLINE void check_pair(Eigen::Index n, Eigen::Index m, Eigen::Index target_n, Eigen::Index target_m);

}  // namespace detail

/// Condenses the columns of \p X and \p Y (n x m each); O(m), no heap for fixed n. If a coordinate is not finite, X and
/// Y of the result are unset.
/// \throws InputError empty_input (no points, or n < 2), size_mismatch
template <class Scalar, int N>
[[nodiscard]] LoopPair<Scalar, N> loop_pair(PointsRef<Scalar, N> X, PointsRef<Scalar, N> Y) {
    detail::check_pair(X.rows(), X.cols(), Y.rows(), Y.cols());
    const Eigen::Index n = X.rows();
    LoopPair<Scalar, N> pair{centring<Scalar, N>(X), centring<Scalar, N>(Y), {}, {}, X.cols()};
    if (!pair.finite()) {
        return pair;
    }
    constexpr int columns = LoopPair<Scalar, N>::rows;
    StreamedQr<Scalar, columns> qr(2 * n);
    Eigen::Matrix<Scalar, 1, columns> row(2 * n);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const auto x = pair.source.local(X.col(i));
        const auto y = pair.target.local(Y.col(i));
        for (Eigen::Index k = 0; k < n; ++k) {
            row(k) = x(k);
            row(n + k) = y(k);
        }
        qr.add(row);
    }
    const auto factor = qr.factor();
    pair.X = factor.leftCols(n);
    pair.Y = factor.rightCols(n);
    return pair;
}

/// The same for any matrix expressions with the points as columns.
template <class DerivedX, class DerivedY>
[[nodiscard]] auto loop_pair(const Eigen::MatrixBase<DerivedX>& X, const Eigen::MatrixBase<DerivedY>& Y) {
    detail::check_pair(X.rows(), X.cols(), Y.rows(), Y.cols());
    return loop_pair<typename DerivedX::Scalar, DerivedX::RowsAtCompileTime>(X.derived(), Y.derived());
}

/// \cond
#define PAVIOR_LOOP_PAIR(prefix, Scalar, N) \
    prefix template LoopPair<Scalar, N> loop_pair<Scalar, N>(PointsRef<Scalar, N>, PointsRef<Scalar, N>);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_LOOP_PAIR, extern)
#endif
/// \endcond

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/affine/loop_pair-inl.hpp>
#endif
