#pragma once
/// \file
/// The constrained affine map: least squares under the condition that the offset direction is kept.

#include <pavior/affine/fit_result.hpp>
#include <pavior/affine/loop_normals.hpp>
#include <pavior/affine/loop_pair.hpp>
#include <pavior/math/small_svd.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>

namespace pavior {

namespace detail {

template <int N>
inline constexpr int one_less = N == Eigen::Dynamic ? N : N - 1;

/// Orthonormal basis (columns) of the hyperplane perpendicular to the unit vector \p normal: the first n - 1 columns of
/// the Householder reflection that takes the last axis to -+normal.
template <class Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, one_less<N>> hyperplane_basis(const Eigen::Matrix<Scalar, N, 1>& normal) {
    const Eigen::Index n = normal.size();
    Eigen::Matrix<Scalar, N, 1> v = normal;
    v(n - 1) += normal(n - 1) < 0 ? Scalar(-1) : Scalar(1);
    const Eigen::Matrix<Scalar, N, N> reflection =
        Eigen::Matrix<Scalar, N, N>::Identity(n, n) - (Scalar(2) / v.squaredNorm()) * v * v.transpose();
    return reflection.leftCols(n - 1);
}

/// Both loops seen along their normals.
template <class Scalar, int N>
struct ProjectedPair {
    using Basis = Eigen::Matrix<Scalar, N, one_less<N>>;
    using Svd = SmallSvd<Scalar, LoopPair<Scalar, N>::rows, one_less<N>>;

    Basis source_basis;
    Svd source;
    Svd target;
    Scalar correlation = 0;  ///< smallest canonical correlation

    ProjectedPair(const LoopPair<Scalar, N>& pair, const LoopNormals<Scalar, N>& normals)
        : source_basis(hyperplane_basis<Scalar, N>(normals.source.normal)),
          source(decompose(pair.X * source_basis)),
          target(decompose(pair.Y * hyperplane_basis<Scalar, N>(normals.target.normal))) {
        using Square = Eigen::Matrix<Scalar, one_less<N>, one_less<N>>;
        const Square overlap = source.U.transpose() * target.U;
        correlation = std::min(Scalar(1), small_svd(overlap).w.minCoeff());
    }

private:
    static Svd decompose(const Eigen::Matrix<Scalar, LoopPair<Scalar, N>::rows, one_less<N>>& M) {
        return small_svd(M);
    }
};

template <class Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> constrained_matrix(const LoopPair<Scalar, N>& pair,
                                                             const ProjectedPair<Scalar, N>& flat,
                                                             const Eigen::Matrix<Scalar, N, 1>& nX,
                                                             const Eigen::Matrix<Scalar, N, 1>& nY) {
    const Eigen::Matrix<Scalar, 1, LoopPair<Scalar, N>::rows> heights = (pair.X * nX).transpose();
    const Eigen::Matrix<Scalar, N, N> in_plane =
        flat.source.solve(pair.Y.transpose(), Scalar(0)) * flat.source_basis.transpose();
    const Eigen::Matrix<Scalar, 1, N> tilt = flat.source.solve(heights, Scalar(0)) * flat.source_basis.transpose();
    return pair.ratio() * in_plane + nY * (nX.transpose() - tilt);
}

}  // namespace detail

/// A = (Ybar - nY h^T)(P Xbar)^+ + nY nX^T with P = I - nX nX^T, h_i = <nX, xbar_i> and phi(x) = A (x - cX) + cY: the
/// unique minimiser of F under A nX = nY, where nX and nY are the pseudo-normals. It keeps length, direction and
/// orientation of offsets, moves with rigid motions, reflections and common scaling, and changes by about as much as
/// the points do. For hyperplanar X it is argmin H(.; nX, nY) (Proposition 2.21 \cite roca2009); it is exact on the
/// loop if
/// and only if Y = T X with T nX = nY.
/// \return status null_pseudo_area, source_degenerate, target_degenerate or unrelated_loops where no such map exists
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> fit_constrained(const LoopPair<Scalar, N>& pair,
                                                   const LoopNormals<Scalar, N>& normals,
                                                   const FitOptions& options = {}) {
    const Eigen::Index n = pair.dimension();
    auto fit = detail::unfitted<Scalar, N>(n);
    const auto degenerate = [&](const auto& svd, Eigen::Index i, const Centring<Scalar, N>& local) {
        return !(svd.w(i) > std::max(static_cast<Scalar>(options.degenerate) * svd.w(0), 4 * local.noise(pair.m)));
    };
    const auto fail = [&](FitStatus status, bool at_target) {
        fit.status = status;
        fit.at_target = at_target;
        return fit;
    };
    if (degenerate(small_svd(pair.X), n - 2, pair.source)) {
        return fail(FitStatus::source_degenerate, false);
    }
    if (degenerate(small_svd(pair.Y), n - 2, pair.target)) {
        return fail(FitStatus::target_degenerate, true);
    }
    if (normals.source.null || normals.target.null) {
        return fail(FitStatus::null_pseudo_area, !normals.source.null);
    }
    const detail::ProjectedPair<Scalar, N> flat(pair, normals);
    if (degenerate(flat.source, n - 2, pair.source)) {
        return fail(FitStatus::source_degenerate, false);
    }
    if (degenerate(flat.target, n - 2, pair.target)) {
        return fail(FitStatus::target_degenerate, true);
    }
    fit.correlation = flat.correlation;
    if (!(flat.correlation > detail::unrelated_threshold<Scalar>(options))) {
        return fail(FitStatus::unrelated_loops, false);
    }
    fit.uX = normals.source.normal;
    fit.uY = normals.target.normal;
    Eigen::Matrix<Scalar, N, N> A = detail::constrained_matrix<Scalar, N>(pair, flat, fit.uX, fit.uY);
    if (normals.signed_by_orientation && A.determinant() < 0) {
        fit.uY = -fit.uY;
        A = detail::constrained_matrix<Scalar, N>(pair, flat, fit.uX, fit.uY);
    }
    fit.rank = static_cast<int>(n);
    fit.map = pair.map(A);
    return fail(FitStatus::ok, false);
}

/// \cond
#define PAVIOR_FIT_CONSTRAINED(prefix, Scalar, N)                                               \
    prefix template AffineFit<Scalar, N> fit_constrained<Scalar, N>(const LoopPair<Scalar, N>&, \
                                                                    const LoopNormals<Scalar, N>&, const FitOptions&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_FIT_CONSTRAINED, extern)
#endif
/// \endcond

}  // namespace pavior
