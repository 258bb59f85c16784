#pragma once
/// \file
/// Affine maps of R^n, kept in the centred form that stays precise far from the origin.

#include <Eigen/Core>

namespace pavior {

/// phi(x) = A (x - cx) + cy, points as columns; Remark 2.1 \cite roca2009. N may be Eigen::Dynamic.
/// The centred form loses no digits when both loops lie far from the origin, and needs no inverse to compose.
template <class Scalar = double, int N = 3>
struct AffineMap {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    using Matrix = Eigen::Matrix<Scalar, N, N>;

    Matrix A;   ///< linear part, n x n
    Vector cx;  ///< centre in the source
    Vector cy;  ///< its image

    /// phi(x). The result is a value: it keeps no reference to \p x.
    template <class Derived>
    [[nodiscard]] Vector operator()(const Eigen::MatrixBase<Derived>& x) const {
        return A * (x - cx) + cy;
    }

    /// A v: the image of a direction.
    template <class Derived>
    [[nodiscard]] Vector direction(const Eigen::MatrixBase<Derived>& v) const {
        return A * v;
    }

    /// b of the translation form phi(x) = A x + b; it cancels digits when |A cx| is far above |b|.
    [[nodiscard]] Vector offset() const { return cy - A * cx; }

    /// The identity of R^n; \p n matters for dynamic N only.
    [[nodiscard]] static AffineMap identity(Eigen::Index n = N) {
        return {Matrix::Identity(n, n), Vector::Zero(n), Vector::Zero(n)};
    }
};

/// outer after inner: x -> outer(inner(x)).
template <class Scalar, int N>
[[nodiscard]] AffineMap<Scalar, N> compose(const AffineMap<Scalar, N>& outer, const AffineMap<Scalar, N>& inner) {
    return {outer.A * inner.A, inner.cx, outer(inner.cy)};
}

}  // namespace pavior
