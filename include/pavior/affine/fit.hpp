#pragma once
/// \file
/// The affine map between two loops, by any of the methods.

#include <pavior/affine/constrained.hpp>
#include <pavior/affine/detail/point_columns.hpp>
#include <pavior/affine/fit_result.hpp>
#include <pavior/affine/loop_normals.hpp>
#include <pavior/affine/loop_pair.hpp>
#include <pavior/affine/method.hpp>
#include <pavior/affine/minimizers.hpp>
#include <pavior/affine/offset_preserving.hpp>
#include <pavior/affine/pseudo_area.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>

namespace pavior {

namespace detail {

/// Methods f and g: no pseudo-normals; the map is set whatever the ranks.
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> fit_plain(AffineMethod method, const LoopPair<Scalar, N>& pair,
                                             const FitOptions& options) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    auto fit = unfitted<Scalar, N>(pair.dimension());
    const PairRanks<Scalar, N> ranks = pair_ranks(pair, options);
    fit.status = rank_status(ranks);
    fit.at_target = fit.status == FitStatus::target_degenerate;
    fit.correlation = std::min(Scalar(1), ranks.correlations.w(pair.dimension() - 2));
    const LinearFit<Scalar, N> linear =
        method == AffineMethod::g ? minimizer_g(pair, options) : minimizer_f(pair, options);
    fit.rank = static_cast<int>(linear.rank);
    if (method == AffineMethod::g) {
        const Vector d = pair.displacement();
        fit.uX = fit.uY = d;
        fit.map = pair.map(linear.A, (linear.A * d - d) / pair.target.scale);
    } else {
        fit.map = pair.map(linear.A);
    }
    return fit;
}

/// max_i |y_i - phi(x_i)|, in local coordinates, where nothing cancels or overflows.
template <class Scalar, int N>
[[nodiscard]] Scalar max_residual(const LoopPair<Scalar, N>& pair, const AffineMap<Scalar, N>& map,
                                  const PointsRef<Scalar, N>& X, const PointsRef<Scalar, N>& Y) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    const Eigen::Matrix<Scalar, N, N> local = map.A * (pair.source.scale / pair.target.scale);
    const Vector shift = (map.cy - pair.target.centre) / pair.target.scale + local * pair.source.shift;
    Scalar residual = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        const Vector error =
            pair.target.local(Y.col(i)) + pair.target.shift - local * pair.source.local(X.col(i)) - shift;
        residual = std::max(residual, error.norm());
    }
    return residual * pair.target.scale;
}

}  // namespace detail

/// Fits an affine map that takes the loops \p X to the loops \p Y by \p method.
/// \param X, Y n x m, column i of Y corresponds to column i of X; the points of all loops one after the other
/// \param loop_offsets as Loops::offsets: loop l is columns loop_offsets[l] .. loop_offsets[l + 1] - 1. Outer loops
///        counter-clockwise, holes clockwise seen from the side that counts as front, the same side for X and Y. For
///        n = 2 a loop is an open curve whose normal is its chord turned by +90 degrees; for n >= 4 only hyperplanar
///        loops have normals. f and g need no loops: {0, m} will do.
/// \return the map with its report. Coordinates that are not finite give status not_finite and a map of NaN.
/// \throws InputError empty_input, size_mismatch, bad_index (offsets)
/// Cost O(m), no heap for fixed n; thread-safe; any coordinates whose differences neither overflow nor underflow.
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> fit_affine(AffineMethod method, PointsRef<Scalar, N> X, PointsRef<Scalar, N> Y,
                                              std::span<const std::size_t> loop_offsets,
                                              const FitOptions& options = {}) {
    const LoopPair<Scalar, N> pair = loop_pair<Scalar, N>(X, Y);
    verify_loop_offsets(loop_offsets, static_cast<std::size_t>(X.cols()));
    auto fit = detail::unfitted<Scalar, N>(X.rows());
    fit.status = FitStatus::not_finite;
    fit.at_target = pair.source.finite;
    if (!pair.finite()) {
        return fit;
    }
    if (method == AffineMethod::f || method == AffineMethod::g) {
        fit = detail::fit_plain<Scalar, N>(method, pair, options);
    } else {
        const LoopNormals<Scalar, N> normals = loop_normals<Scalar, N>(pair, X, Y, loop_offsets, options);
        fit = method == AffineMethod::h ? fit_offset_preserving<Scalar, N>(pair, normals, options)
                                        : fit_constrained<Scalar, N>(pair, normals, options);
    }
    const bool has_map = fit.status == FitStatus::ok || method == AffineMethod::f || method == AffineMethod::g;
    if (has_map) {
        fit.residual = detail::max_residual<Scalar, N>(pair, fit.map, X, Y);
        const bool overflowed = !fit.map.A.allFinite() || !fit.map.cy.allFinite();
        fit.status = overflowed ? FitStatus::not_finite : fit.status;
    }
    return fit;
}

/// The same for any matrix expression with the points as columns: Matrix3Xd, Map, Block, transposed rows. What does not
/// lie in memory column by column is evaluated into a matrix first.
template <class DerivedX, class DerivedY>
[[nodiscard]] auto fit_affine(AffineMethod method, const Eigen::MatrixBase<DerivedX>& X,
                              const Eigen::MatrixBase<DerivedY>& Y, std::span<const std::size_t> loop_offsets,
                              const FitOptions& options = {}) {
    using Scalar = typename DerivedX::Scalar;
    constexpr int N = DerivedX::RowsAtCompileTime;
    using Points = PointsRef<Scalar, N>;
    return fit_affine<Scalar, N>(method, Points(X.derived()), Points(Y.derived()), loop_offsets, options);
}

/// The same for points in space as they are kept in meshes: vectors, arrays, spans, anything that is a point_range.
/// Coordinates that are three doubles in memory, at equal distances from point to point, are read in place; others are
/// copied.
template <point_range SourcePoints, point_range TargetPoints>
[[nodiscard]] AffineFit<double, 3> fit_affine(AffineMethod method, const SourcePoints& source,
                                              const TargetPoints& target, std::span<const std::size_t> loop_offsets,
                                              const FitOptions& options = {}) {
    const detail::PointColumns X(source), Y(target);
    return fit_affine<double, 3>(method, X.matrix(), Y.matrix(), loop_offsets, options);
}

/// \cond
#define PAVIOR_FIT_AFFINE(prefix, Scalar, N)                    \
    prefix template AffineFit<Scalar, N> fit_affine<Scalar, N>( \
        AffineMethod, PointsRef<Scalar, N>, PointsRef<Scalar, N>, std::span<const std::size_t>, const FitOptions&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_FIT_AFFINE, extern)
#endif
/// \endcond

}  // namespace pavior
