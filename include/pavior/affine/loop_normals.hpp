#pragma once
/// \file
/// The pseudo-normals of a pair of loops, as offset-preserving fits use them.

#include <pavior/affine/fit_result.hpp>
#include <pavior/affine/loop_pair.hpp>
#include <pavior/affine/pseudo_area.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace pavior {

/// nX and nY. For n >= 4 they are normals of hyperplanes with arbitrary signs (`signed_by_orientation`): the sign of nY
/// is then fixed by det A > 0, which affine loops in space satisfy by themselves.
template <class Scalar, int N>
struct LoopNormals {
    PseudoNormal<Scalar, N> source;
    PseudoNormal<Scalar, N> target;
    bool signed_by_orientation = false;
};

/// O(m). The columns of \p X and \p Y are the points that \p pair was made of; offsets as in Loops::offsets.
template <class Scalar, int N>
[[nodiscard]] LoopNormals<Scalar, N> loop_normals(const LoopPair<Scalar, N>& pair, PointsRef<Scalar, N> X,
                                                  PointsRef<Scalar, N> Y, std::span<const std::size_t> offsets,
                                                  const FitOptions& options) {
    if (pair.dimension() <= 3) {
        return {pseudo_normal<Scalar, N>(enclosure<Scalar, N>(X, offsets, pair.source), pair.source,
                                         options.null_pseudo_area),
                pseudo_normal<Scalar, N>(enclosure<Scalar, N>(Y, offsets, pair.target), pair.target,
                                         options.null_pseudo_area),
                false};
    }
    const auto of = [&](const auto& points, const Centring<Scalar, N>& local) {
        const auto svd = small_svd(points);
        return hyperplane_normal(
            svd, std::max(static_cast<Scalar>(options.zero_singular_value) * svd.w(0), 16 * local.noise(pair.m)));
    };
    return {of(pair.X, pair.source), of(pair.Y, pair.target), true};
}

/// The same for any matrix expressions with the points as columns.
template <class DerivedX, class DerivedY, class Scalar, int N>
[[nodiscard]] LoopNormals<Scalar, N> loop_normals(const LoopPair<Scalar, N>& pair, const Eigen::MatrixBase<DerivedX>& X,
                                                  const Eigen::MatrixBase<DerivedY>& Y,
                                                  std::span<const std::size_t> offsets, const FitOptions& options) {
    using Points = PointsRef<Scalar, N>;
    return loop_normals<Scalar, N>(pair, Points(X.derived()), Points(Y.derived()), offsets, options);
}

/// \cond
#define PAVIOR_LOOP_NORMALS(prefix, Scalar, N)                                                                         \
    prefix template LoopNormals<Scalar, N> loop_normals<Scalar, N>(const LoopPair<Scalar, N>&, PointsRef<Scalar, N>,   \
                                                                   PointsRef<Scalar, N>, std::span<const std::size_t>, \
                                                                   const FitOptions&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_LOOP_NORMALS, extern)
#endif
/// \endcond

}  // namespace pavior
