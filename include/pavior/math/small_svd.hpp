#pragma once
/// \file
/// Singular value decomposition of the small matrices of the affine methods, and the decision of their rank.

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <utility>

namespace pavior {

/// M = U diag(w) V^T with M of size R x C, R >= C: U has C orthonormal columns, V is C x C orthogonal and
/// w_0 >= w_1 >= ... >= 0.
template <class Scalar, int R, int C>
struct SmallSvd {
    Eigen::Matrix<Scalar, R, C> U;
    Eigen::Matrix<Scalar, C, 1> w;
    Eigen::Matrix<Scalar, C, C> V;

    /// Number of singular values above \p threshold (absolute).
    [[nodiscard]] Eigen::Index rank(Scalar threshold) const { return (w.array() > threshold).count(); }

    /// The pseudo-inverse diag(w)^+ V^T applied from the right: B U diag(w)^+ V^T, which minimises |B - A M^T| over A
    /// and, among the minimisers, |A|. Singular values at or below \p threshold count as zero; equation (3.2)
    /// \cite roca2009.
    template <class Derived>
    [[nodiscard]] Eigen::Matrix<Scalar, Derived::RowsAtCompileTime, C> solve(const Eigen::MatrixBase<Derived>& B,
                                                                             Scalar threshold) const {
        Eigen::Matrix<Scalar, Derived::RowsAtCompileTime, C> coefficients = B * U;
        for (Eigen::Index i = 0; i < w.size(); ++i) {
            coefficients.col(i) *= w(i) > threshold ? Scalar(1) / w(i) : Scalar(0);
        }
        return coefficients * V.transpose();
    }
};

/// Decomposes \p M (R x C, R >= C >= 1) by one-sided Jacobi rotations: singular values are accurate to a few units of
/// rounding of the largest one, and to their own rounding where the columns are merely scaled badly. Entries should be
/// of moderate size (scale first); NaN gives NaN. O(R C^2) per sweep, some six sweeps, 60 at most; no heap for fixed
/// sizes. Compiled once for float and double in pavior::compiled, otherwise inline.
template <class Scalar, int R, int C>
[[nodiscard]] SmallSvd<Scalar, R, C> small_svd(const Eigen::Matrix<Scalar, R, C>& M);

namespace detail {

/// Makes columns i and j of U orthogonal, turning V alike. \return true if they were not orthogonal already
template <class Scalar, int R, int C>
bool orthogonalize_columns(SmallSvd<Scalar, R, C>& svd, Eigen::Index i, Eigen::Index j) {
    Scalar aa = 0;
    Scalar bb = 0;
    Scalar ab = 0;
    for (Eigen::Index k = 0; k < svd.U.rows(); ++k) {
        aa += svd.U(k, i) * svd.U(k, i);
        bb += svd.U(k, j) * svd.U(k, j);
        ab += svd.U(k, i) * svd.U(k, j);
    }
    if (!(std::abs(ab) > 2 * std::numeric_limits<Scalar>::epsilon() * std::sqrt(aa) * std::sqrt(bb))) {
        return false;
    }
    const Scalar zeta = (bb - aa) / (2 * ab);
    const Scalar tangent = std::copysign(Scalar(1), zeta) / (std::abs(zeta) + std::hypot(Scalar(1), zeta));
    const Scalar c = Scalar(1) / std::sqrt(1 + tangent * tangent);
    const Scalar s = c * tangent;
    const auto turn = [&](auto& matrix) {
        for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
            const Scalar a = matrix(k, i);
            const Scalar b = matrix(k, j);
            matrix(k, i) = c * a - s * b;
            matrix(k, j) = s * a + c * b;
        }
    };
    turn(svd.U);
    turn(svd.V);
    return true;
}

/// Sets column i of U, whose singular value is zero, to a unit vector perpendicular to columns 0 .. i - 1.
template <class Scalar, int R, int C>
void complete_column(SmallSvd<Scalar, R, C>& svd, Eigen::Index i) {
    Eigen::Matrix<Scalar, R, 1> best = Eigen::Matrix<Scalar, R, 1>::Zero(svd.U.rows());
    for (Eigen::Index axis = 0; axis < svd.U.rows(); ++axis) {
        Eigen::Matrix<Scalar, R, 1> v = Eigen::Matrix<Scalar, R, 1>::Unit(svd.U.rows(), axis);
        for (Eigen::Index twice = 0; twice < 2; ++twice) {
            for (Eigen::Index k = 0; k < i; ++k) {
                v -= svd.U.col(k).dot(v) * svd.U.col(k);
            }
        }
        if (v.squaredNorm() > best.squaredNorm()) {
            best = v;
        }
    }
    svd.U.col(i) = best / best.norm();
}

}  // namespace detail

template <class Scalar, int R, int C>
SmallSvd<Scalar, R, C> small_svd(const Eigen::Matrix<Scalar, R, C>& M) {
    const Eigen::Index n = M.cols();
    SmallSvd<Scalar, R, C> svd{M, Eigen::Matrix<Scalar, C, 1>::Zero(n), Eigen::Matrix<Scalar, C, C>::Identity(n, n)};
    bool turned = true;
    for (int sweep = 0; sweep < 60 && turned; ++sweep) {
        turned = false;
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = i + 1; j < n; ++j) {
                turned |= detail::orthogonalize_columns(svd, i, j);
            }
        }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        svd.w(i) = svd.U.col(i).norm();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        Eigen::Index largest = i;
        for (Eigen::Index j = i + 1; j < n; ++j) {
            largest = svd.w(j) > svd.w(largest) ? j : largest;
        }
        std::swap(svd.w(i), svd.w(largest));
        svd.U.col(i).swap(svd.U.col(largest));
        svd.V.col(i).swap(svd.V.col(largest));
        if (svd.w(i) == Scalar(0)) {
            detail::complete_column(svd, i);
        } else {
            svd.U.col(i) /= svd.w(i);
        }
    }
    return svd;
}

/// \cond
#define PAVIOR_SMALL_SVD_SIZES(apply, Scalar)                                                               \
    apply(Scalar, 2, 2) apply(Scalar, 3, 3) apply(Scalar, 4, 4) apply(Scalar, 4, 2) apply(Scalar, 6, 3)     \
        apply(Scalar, 8, 4) apply(Scalar, 1, 1) apply(Scalar, 4, 1) apply(Scalar, 6, 2) apply(Scalar, 8, 3) \
            apply(Scalar, 5, 2) apply(Scalar, 7, 3) apply(Scalar, 9, 4) apply(Scalar, Eigen::Dynamic, Eigen::Dynamic)
#ifdef PAVIOR_COMPILED
#define PAVIOR_EXTERN_SVD(Scalar, R, C) \
    extern template SmallSvd<Scalar, R, C> small_svd<Scalar, R, C>(const Eigen::Matrix<Scalar, R, C>&);
PAVIOR_SMALL_SVD_SIZES(PAVIOR_EXTERN_SVD, double)
#undef PAVIOR_EXTERN_SVD
#endif
/// \endcond

}  // namespace pavior
