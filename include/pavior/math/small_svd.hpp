#pragma once
/// \file
/// Singular value decomposition of the small matrices of the affine methods, and the decision of their rank.

#include <Eigen/Core>
#include <Eigen/SVD>

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

/// Decomposes \p M (R x C, R >= C >= 1). One- or two-sided Jacobi behind a pivoted QR: singular values are accurate to
/// a few units of rounding of the largest one. Entries should be of moderate size (scale first); NaN gives NaN.
/// No heap for fixed sizes. Compiled once for float and double in pavior::math, otherwise inline.
template <class Scalar, int R, int C>
[[nodiscard]] SmallSvd<Scalar, R, C> small_svd(const Eigen::Matrix<Scalar, R, C>& M) {
    const Eigen::JacobiSVD<Eigen::Matrix<Scalar, R, C>> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {svd.matrixU().leftCols(M.cols()), svd.singularValues(), svd.matrixV()};
}

/// \cond
#define PAVIOR_SMALL_SVD_SIZES(apply, Scalar) \
    apply(Scalar, 2, 2) apply(Scalar, 3, 3) apply(Scalar, 4, 4) apply(Scalar, 4, 2) apply(Scalar, 6, 3) \
        apply(Scalar, 8, 4) apply(Scalar, 1, 1) apply(Scalar, 4, 1) apply(Scalar, 6, 2) apply(Scalar, 8, 3) \
            apply(Scalar, 5, 2) apply(Scalar, 7, 3) apply(Scalar, 9, 4) \
            apply(Scalar, Eigen::Dynamic, Eigen::Dynamic)
#ifdef PAVIOR_COMPILED_MATH
#define PAVIOR_EXTERN_SVD(Scalar, R, C) \
    extern template SmallSvd<Scalar, R, C> small_svd<Scalar, R, C>(const Eigen::Matrix<Scalar, R, C>&);
PAVIOR_SMALL_SVD_SIZES(PAVIOR_EXTERN_SVD, float)
PAVIOR_SMALL_SVD_SIZES(PAVIOR_EXTERN_SVD, double)
#undef PAVIOR_EXTERN_SVD
#endif
/// \endcond

}  // namespace pavior
