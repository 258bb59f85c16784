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
#include <cstdint>
#include <string_view>

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
    [[nodiscard]] Vector kernel() const;

    /// The unit vector perpendicular to Range A^F. \pre rank == n - 1
    [[nodiscard]] Vector cokernel() const;
};

template <class Scalar, int N>
Eigen::Matrix<Scalar, N, 1> PairRanks<Scalar, N>::kernel() const {
    const Eigen::Index last = source.w.size() - 1;
    if (source_rank <= last) {
        return source.V.col(last);
    }
    return (source.V * (source.w.array() * correlations.V.col(last).array()).matrix()).normalized();
}

template <class Scalar, int N>
Eigen::Matrix<Scalar, N, 1> PairRanks<Scalar, N>::cokernel() const {
    const Eigen::Index last = target.w.size() - 1;
    if (target_rank <= last) {
        return target.V.col(last);
    }
    return (target.V * (correlations.U.col(last).array() / target.w.array()).matrix()).normalized();
}

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

/// How step 3 of Algorithm 3.1 chooses its vectors.
enum class OffsetCase : std::uint8_t {
    pseudo_normals,  ///< 3.a: A^F is regular
    kernel,          ///< 3.b: Ker A^F is a line
    degenerate       ///< 3.c: Ker A^F is more than that, there are no vectors
};

/// "3.a", "3.b" or "3.c".
[[nodiscard]] constexpr std::string_view to_string(OffsetCase which) noexcept {
    switch (which) {
        case OffsetCase::pseudo_normals: return "3.a";
        case OffsetCase::kernel: return "3.b";
        case OffsetCase::degenerate: return "3.c";
    }
    return "unknown";
}

/// The vectors u^X and u^Y of Algorithm 3.1, and how they were chosen.
template <class Scalar, int N>
struct OffsetVectors {
    using Vector = Eigen::Matrix<Scalar, N, 1>;

    Vector uX;  ///< unit, mapped to uY; zero unless `status == ok`
    Vector uY;  ///< unit
    OffsetCase which = OffsetCase::degenerate;
    FitStatus status = FitStatus::ok;  ///< ok if there are vectors, otherwise why not
    bool at_target = false;            ///< null_pseudo_area, not_finite: the target loop is at fault, else the source
    bool ambiguous_normal = false;     ///< 3.b: a vector is perpendicular to its pseudo-normal, its sign is arbitrary
    bool source_hyperplanar = false;   ///< X, row of Table 3.1
    bool target_hyperplanar = false;   ///< Y, column of Table 3.1
    int rank = 0;                      ///< numerical rank of the centred source
    Scalar correlation = 0;            ///< smallest of the n - 1 largest canonical correlations of the loops, in [0, 1]
};

namespace detail {

/// What case the loops are, and whether it has vectors.
template <class Scalar, int N>
[[nodiscard]] OffsetVectors<Scalar, N> offset_case(const PairRanks<Scalar, N>& ranks,
                                                   const LoopNormals<Scalar, N>& normals) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    const Eigen::Index n = ranks.source.w.size();
    OffsetVectors<Scalar, N> result{Vector::Zero(n), Vector::Zero(n)};
    result.rank = static_cast<int>(ranks.source_rank);
    result.correlation = std::min(Scalar(1), ranks.correlations.w(n - 2));
    result.source_hyperplanar = ranks.source_rank == n - 1;
    result.target_hyperplanar = ranks.target_rank == n - 1;
    result.status = rank_status(ranks);
    result.at_target = result.status == FitStatus::target_degenerate;
    if (result.status != FitStatus::ok) {
        return result;
    }
    result.which = ranks.rank == n ? OffsetCase::pseudo_normals : OffsetCase::kernel;
    const bool signs_only = normals.signed_by_orientation && result.which == OffsetCase::kernel;
    if (!signs_only && (normals.source.null || normals.target.null)) {
        result.status = FitStatus::null_pseudo_area;
        result.at_target = !normals.source.null;
    }
    return result;
}

/// A = A^F (I - uX uX^T) + uY uX^T, step 4.
template <class Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> offset_preserving_map(const Eigen::Matrix<Scalar, N, N>& AF,
                                                                const OffsetVectors<Scalar, N>& vectors) {
    return AF - (AF * vectors.uX - vectors.uY) * vectors.uX.transpose();
}

}  // namespace detail

/// Step 3 of Algorithm 3.1: the vectors that the map takes to each other, Table 3.1. With A^F the minimiser of F of
/// smallest norm:
/// - 3.a, A^F regular: uX, uY are the pseudo-normals;
/// - 3.b, Ker A^F a line: uX spans it and uY spans the complement of the range, with signs such that
///   <uX, nX> > 0 and <uY, nY> > 0 (`ambiguous_normal` where a cosine is too small to tell). A hyperplanar X makes uX
///   its normal, a hyperplanar Y makes uY its;
/// - 3.c otherwise: no vectors, status source_degenerate, target_degenerate or unrelated_loops.
/// 3.a needs both loops to span space, but two such loops may have a singular A^F, which Table 3.1 leaves out: 3.b.
/// Loops without area are null_pseudo_area in either case; coordinates that are not finite, not_finite.
/// A singular value w of a loop counts as zero if w <= max(1e-8, 16 eps sqrt(m) max|x| / w_1) w_1. n >= 4: no
/// pseudo-normals; signs give det A > 0 in case 3.b, and case 3.a is null_pseudo_area.
/// \param pair, normals  loop_pair() and loop_normals() of the loops
/// O(1), no heap for fixed n; thread-safe.
template <class Scalar, int N>
[[nodiscard]] OffsetVectors<Scalar, N> offset_vectors(const LoopPair<Scalar, N>& pair,
                                                      const LoopNormals<Scalar, N>& normals,
                                                      const FitOptions& options = {}) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    if (!pair.finite()) {
        const Vector zero = Vector::Zero(pair.dimension());
        return {zero, zero, OffsetCase::degenerate, FitStatus::not_finite, pair.source.finite};
    }
    const PairRanks<Scalar, N> ranks = pair_ranks(pair, options);
    OffsetVectors<Scalar, N> result = detail::offset_case(ranks, normals);
    if (result.status != FitStatus::ok) {
        return result;
    }
    if (result.which == OffsetCase::pseudo_normals) {
        result.uX = normals.source.normal;
        result.uY = normals.target.normal;
        return result;
    }
    result.uX = ranks.kernel();
    result.uY = ranks.cokernel();
    if (normals.signed_by_orientation) {
        const bool mirrored = detail::offset_preserving_map(minimizer_f(pair, options).A, result).determinant() < 0;
        result.uY = mirrored ? Vector(-result.uY) : result.uY;
        return result;
    }
    const auto align = [&](Vector& vector, const Vector& normal) {
        const Scalar cosine = vector.dot(normal);
        result.ambiguous_normal |= std::abs(cosine) < static_cast<Scalar>(options.ambiguous_cosine);
        vector = cosine < 0 ? Vector(-vector) : vector;
    };
    align(result.uX, normals.source.normal);
    align(result.uY, normals.target.normal);
    return result;
}

/// Algorithm 3.1: A = A^F (I - uX uX^T) + uY uX^T with A^F the minimiser of F of smallest norm and the vectors of
/// offset_vectors(); no map where there are none.
/// The result jumps where a singular value passes the tolerance, and noise eps on a nearly planar loop may be amplified
/// by misfit / eps: prefer fit_constrained.
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> fit_offset_preserving(const LoopPair<Scalar, N>& pair,
                                                         const LoopNormals<Scalar, N>& normals,
                                                         const FitOptions& options = {}) {
    auto fit = detail::unfitted<Scalar, N>(pair.dimension());
    const OffsetVectors<Scalar, N> vectors = offset_vectors(pair, normals, options);
    fit.status = vectors.status;
    fit.at_target = vectors.at_target;
    fit.ambiguous_normal = vectors.ambiguous_normal;
    fit.rank = vectors.rank;
    fit.correlation = vectors.correlation;
    if (fit.status == FitStatus::ok) {
        fit.uX = vectors.uX;
        fit.uY = vectors.uY;
        fit.map = pair.map(detail::offset_preserving_map(minimizer_f(pair, options).A, vectors));
    }
    return fit;
}

/// \cond
#define PAVIOR_OFFSET_PRESERVING(prefix, Scalar, N)                                                            \
    prefix template PairRanks<Scalar, N> pair_ranks<Scalar, N>(const LoopPair<Scalar, N>&, const FitOptions&); \
    prefix template OffsetVectors<Scalar, N> offset_vectors<Scalar, N>(                                        \
        const LoopPair<Scalar, N>&, const LoopNormals<Scalar, N>&, const FitOptions&);                         \
    prefix template AffineFit<Scalar, N> fit_offset_preserving<Scalar, N>(                                     \
        const LoopPair<Scalar, N>&, const LoopNormals<Scalar, N>&, const FitOptions&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_OFFSET_PRESERVING, extern)
#endif
/// \endcond

}  // namespace pavior
