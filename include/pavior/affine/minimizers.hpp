#pragma once
/// \file
/// Minimum-norm minimisers of the functionals E, F, G and H; Chapter 2 \cite roca2009.

#include <pavior/affine/fit_result.hpp>
#include <pavior/affine/loop_pair.hpp>
#include <pavior/math/small_svd.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace pavior {

/// A linear least-squares fit.
template <class Scalar, int N>
struct LinearFit {
    Eigen::Matrix<Scalar, N, N> A;  ///< the minimiser of smallest Frobenius norm, n x n
    Eigen::Index rank = 0;          ///< numerical rank of the n uncoupled systems (2.13), (A.2), (A.3)
    Eigen::Matrix<Scalar, N, 1> w;  ///< singular values of the system matrix, user's unit, descending
    [[nodiscard]] bool unique() const { return rank == A.rows(); }
};

namespace detail {

/// Threshold for "w = 0": relative to w_1, and above the rounding error of the coordinates.
template <class Scalar, int R, int N>
[[nodiscard]] Scalar zero_threshold(const SmallSvd<Scalar, R, N>& svd, double relative, Scalar noise) {
    return std::max(static_cast<Scalar>(relative) * svd.w(0), 16 * noise);
}

/// min |Y - A X|^2 + |u_y - A u_x|^2 in local coordinates; \p noise is the noise level of the singular values.
template <class Scalar, int N>
[[nodiscard]] LinearFit<Scalar, N> fit_with_row(const LoopPair<Scalar, N>& pair, const Eigen::Matrix<Scalar, N, 1>& ux,
                                                const Eigen::Matrix<Scalar, N, 1>& uy, Scalar noise,
                                                double zero_singular_value) {
    constexpr int rows = N == Eigen::Dynamic ? N : 2 * N + 1;
    const Eigen::Index n = pair.dimension();
    Eigen::Matrix<Scalar, rows, N> X(2 * n + 1, n);
    Eigen::Matrix<Scalar, rows, N> Y(2 * n + 1, n);
    X << pair.X, ux.transpose();
    Y << pair.Y, uy.transpose();
    const auto svd = small_svd(X);
    const Scalar zero = zero_threshold(svd, zero_singular_value, noise);
    return {pair.ratio() * svd.solve(Y.transpose(), zero), svd.rank(zero), svd.w * pair.source.scale};
}

}  // namespace detail

/// A^F = argmin F, equation (3.2), of smallest norm; it is A^E as well (Proposition 2.17), with b^E = cY
/// (Proposition 2.2).
template <class Scalar, int N>
[[nodiscard]] LinearFit<Scalar, N> minimizer_f(const LoopPair<Scalar, N>& pair, const FitOptions& options = {}) {
    const auto svd = small_svd(pair.X);
    const Scalar zero = detail::zero_threshold(svd, options.zero_singular_value, pair.source.noise(pair.m));
    return {pair.ratio() * svd.solve(pair.Y.transpose(), zero), svd.rank(zero), svd.w * pair.source.scale};
}

/// A^G = argmin G of smallest norm. Since the local coordinates sum to zero, G(A) = F(A) + m |d - A d|^2 with
/// d = cY - cX.
template <class Scalar, int N>
[[nodiscard]] LinearFit<Scalar, N> minimizer_g(const LoopPair<Scalar, N>& pair, const FitOptions& options = {}) {
    const Scalar root = std::sqrt(static_cast<Scalar>(pair.m));
    const Eigen::Matrix<Scalar, N, 1> d = pair.displacement();
    const Scalar noise =
        std::max(pair.source.noise(pair.m), pair.target.noise(pair.m) * (pair.target.scale / pair.source.scale));
    return detail::fit_with_row<Scalar, N>(pair, root * (d / pair.source.scale), root * (d / pair.target.scale), noise,
                                           options.zero_singular_value);
}

/// A^H = argmin H(.; uX, uY) of smallest norm, for any uX and uY (user's unit): n systems of least squares (A.3).
template <class Scalar, int N>
[[nodiscard]] LinearFit<Scalar, N> minimizer_h(const LoopPair<Scalar, N>& pair, const Eigen::Matrix<Scalar, N, 1>& uX,
                                               const Eigen::Matrix<Scalar, N, 1>& uY, const FitOptions& options = {}) {
    return detail::fit_with_row<Scalar, N>(pair, uX / pair.source.scale, uY / pair.target.scale,
                                           pair.source.noise(pair.m), options.zero_singular_value);
}

/// (A^E, b^E) = argmin E(A, b) as a map.
template <class Scalar, int N>
[[nodiscard]] AffineMap<Scalar, N> minimizer_e(const LoopPair<Scalar, N>& pair, const FitOptions& options = {}) {
    return pair.map(minimizer_f(pair, options).A);
}

/// \cond
#define PAVIOR_MINIMIZERS(prefix, Scalar, N)                                                                    \
    prefix template LinearFit<Scalar, N> minimizer_f<Scalar, N>(const LoopPair<Scalar, N>&, const FitOptions&); \
    prefix template LinearFit<Scalar, N> minimizer_g<Scalar, N>(const LoopPair<Scalar, N>&, const FitOptions&); \
    prefix template LinearFit<Scalar, N> minimizer_h<Scalar, N>(                                                \
        const LoopPair<Scalar, N>&, const Eigen::Matrix<Scalar, N, 1>&, const Eigen::Matrix<Scalar, N, 1>&,     \
        const FitOptions&);                                                                                     \
    prefix template AffineMap<Scalar, N> minimizer_e<Scalar, N>(const LoopPair<Scalar, N>&, const FitOptions&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_MINIMIZERS, extern)
#endif
/// \endcond

}  // namespace pavior
