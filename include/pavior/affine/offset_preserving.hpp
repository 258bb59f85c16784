#pragma once
/// \file
/// Algorithm 3.1 \cite roca2009 : the offset-preserving affine projection, with tolerances and signs settled.

#include <pavior/affine/fit_result.hpp>
#include <pavior/affine/loop_normals.hpp>
#include <pavior/affine/loop_pair.hpp>
#include <pavior/affine/minimizers.hpp>
#include <pavior/math/small_svd.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace pavior {

/// Ranks of two loops and of the linear map between them. The rank of A^F is counted by canonical correlations, which
/// do not depend on the shapes of the loops: a section of 1e6 : 1 may become one of 1 : 1e6.
template <class Scalar, int N>
struct PairRanks {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    using Svd = SmallSvd<Scalar, LoopPair<Scalar, N>::rows, N>;

    Svd source;  ///< of Xbar^T in local coordinates
    Svd target;  ///< of Ybar^T
    Eigen::Index source_rank = 0;
    Eigen::Index target_rank = 0;
    SmallSvd<Scalar, N, N> correlations;  ///< of the overlap of the two column spaces; w = canonical correlations
    Eigen::Index rank = 0;                ///< of A^F

    /// The unit vector that spans Ker A^F. \pre rank == n - 1
    [[nodiscard]] Vector kernel() const {
        const Eigen::Index last = source.w.size() - 1;
        if (source_rank <= last) {
            return source.V.col(last);
        }
        return (source.V * (source.w.array() * correlations.V.col(last).array()).matrix()).normalized();
    }

    /// The unit vector perpendicular to Range A^F. \pre rank == n - 1
    [[nodiscard]] Vector cokernel() const {
        const Eigen::Index last = target.w.size() - 1;
        if (target_rank <= last) {
            return target.V.col(last);
        }
        return (target.V * (correlations.U.col(last).array() / target.w.array()).matrix()).normalized();
    }
};

/// Counts the ranks of a pair of loops with the tolerances of \p options.
template <class Scalar, int N>
[[nodiscard]] PairRanks<Scalar, N> pair_ranks(const LoopPair<Scalar, N>& pair, const FitOptions& options = {}) {
    PairRanks<Scalar, N> ranks{small_svd(pair.X), small_svd(pair.Y), 0, 0, {}, 0};
    ranks.source_rank =
        ranks.source.rank(detail::zero_threshold(ranks.source, options.zero_singular_value, pair.source.noise(pair.m)));
    ranks.target_rank =
        ranks.target.rank(detail::zero_threshold(ranks.target, options.zero_singular_value, pair.target.noise(pair.m)));
    const Eigen::Index n = pair.dimension();
    Eigen::Matrix<Scalar, N, N> overlap = ranks.target.U.transpose() * ranks.source.U;
    overlap.bottomRows(n - ranks.target_rank).setZero();
    overlap.rightCols(n - ranks.source_rank).setZero();
    ranks.correlations = small_svd(overlap);
    ranks.rank = ranks.correlations.rank(detail::unrelated_threshold<Scalar>(options));
    return ranks;
}

/// ok if Range A^F is a hyperplane at least, else what is to blame.
template <class Scalar, int N>
[[nodiscard]] FitStatus rank_status(const PairRanks<Scalar, N>& ranks) {
    const Eigen::Index hyperplane = ranks.source.w.size() - 1;
    if (ranks.source_rank < hyperplane) {
        return FitStatus::source_degenerate;
    }
    if (ranks.target_rank < hyperplane) {
        return FitStatus::target_degenerate;
    }
    return ranks.rank < hyperplane ? FitStatus::unrelated_loops : FitStatus::ok;
}

namespace detail {

/// The vectors of step 3, signs aligned with the pseudo-normals; sets ambiguous_normal.
template <class Scalar, int N>
void select_offset_vectors(const PairRanks<Scalar, N>& ranks, const LoopNormals<Scalar, N>& normals,
                           const FitOptions& options, AffineFit<Scalar, N>& fit) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    if (ranks.rank == ranks.source.w.size()) {
        fit.uX = normals.source.normal;
        fit.uY = normals.target.normal;
        return;
    }
    const auto aligned = [&](const Vector& vector, const Vector& normal) -> Vector {
        const Scalar cosine = vector.dot(normal);
        fit.ambiguous_normal |= std::abs(cosine) < static_cast<Scalar>(options.ambiguous_cosine);
        return cosine < 0 ? Vector(-vector) : vector;
    };
    fit.uX = ranks.kernel();
    fit.uY = ranks.cokernel();
    if (!normals.signed_by_orientation) {
        fit.uX = aligned(fit.uX, normals.source.normal);
        fit.uY = aligned(fit.uY, normals.target.normal);
    }
}

}  // namespace detail

/// Algorithm 3.1. With A^F the minimiser of F of smallest norm:
/// - 3.a, A^F regular: uX, uY are the pseudo-normals;
/// - 3.b, Ker A^F a line: uX spans it and uY spans the complement of the range, with signs such that
///   <uX, nX> > 0 and <uY, nY> > 0 (`ambiguous_normal` where a cosine is too small to tell);
/// - 3.c otherwise: no map, status source_degenerate, target_degenerate or unrelated_loops.
/// A = A^F (I - uX uX^T) + uY uX^T. A singular value w of a loop counts as zero if
/// w <= max(1e-8, 16 eps sqrt(m) max|x| / w_1) w_1. n >= 4: no pseudo-normals; signs give det A > 0 in case 3.b, and
/// case 3.a is null_pseudo_area.
/// The result jumps where a singular value passes the tolerance, and noise eps on a nearly planar loop may be amplified
/// by misfit / eps: prefer fit_constrained.
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> fit_offset_preserving(const LoopPair<Scalar, N>& pair,
                                                         const LoopNormals<Scalar, N>& normals,
                                                         const FitOptions& options = {}) {
    const Eigen::Index n = pair.dimension();
    auto fit = detail::unfitted<Scalar, N>(n);
    const PairRanks<Scalar, N> ranks = pair_ranks(pair, options);
    fit.rank = static_cast<int>(ranks.source_rank);
    fit.correlation = std::min(Scalar(1), ranks.correlations.w(n - 2));
    fit.status = rank_status(ranks);
    fit.at_target = fit.status == FitStatus::target_degenerate;
    if (fit.status != FitStatus::ok) {
        return fit;
    }
    const bool signs_only = normals.signed_by_orientation && ranks.rank == n - 1;
    if (!signs_only && (normals.source.null || normals.target.null)) {
        fit.status = FitStatus::null_pseudo_area;
        fit.at_target = !normals.source.null;
        return fit;
    }
    detail::select_offset_vectors(ranks, normals, options, fit);
    const Eigen::Matrix<Scalar, N, N> AF = minimizer_f(pair, options).A;
    Eigen::Matrix<Scalar, N, N> A = AF - (AF * fit.uX - fit.uY) * fit.uX.transpose();
    if (normals.signed_by_orientation && A.determinant() < 0) {
        fit.uY = -fit.uY;
        A = AF - (AF * fit.uX - fit.uY) * fit.uX.transpose();
    }
    fit.map = pair.map(A);
    return fit;
}

}  // namespace pavior
