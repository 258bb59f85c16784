#pragma once
/// \file
/// Are two point sets affine images of each other? Propositions 2.25 to 2.27 \cite roca2009.

#include <pavior/affine/loop_pair.hpp>
#include <pavior/affine/minimizers.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace pavior {

/// How far two point sets are from being affine.
template <class Scalar>
struct Affinity {
    Scalar defect = 0;    ///< sqrt(min F) / |Ybar|: 0 if an affine map is exact, at most 1; 0 if all y_i coincide
    Scalar rounding = 0;  ///< the part of the defect that rounding of the coordinates may cause

    /// An affine map takes every x_i to y_i, within \p tolerance times the size of Y or within rounding.
    [[nodiscard]] bool exact(double tolerance = 1e-12) const {
        return defect <= std::max(static_cast<Scalar>(tolerance), rounding);
    }
};

/// min F relative to the scale of Y: an exact affine map exists if and only if it is zero (Proposition 2.25). No
/// singular value above the rounding level is neglected. \pre pair.finite()
template <class Scalar, int N>
[[nodiscard]] Affinity<Scalar> affinity(const LoopPair<Scalar, N>& pair) {
    FitOptions options;
    options.zero_singular_value = 0;
    const Scalar size = pair.Y.norm();
    if (!(size > Scalar(0))) {
        return {};
    }
    const Eigen::Matrix<Scalar, N, N> A = minimizer_f(pair, options).A / pair.ratio();
    const Scalar rounding = 16 * (pair.target.noise(pair.m) + A.norm() * pair.source.noise(pair.m));
    return {(pair.Y - pair.X * A.transpose()).norm() / size, rounding / size};
}

/// True if some affine map takes column i of \p X to column i of \p Y for all i (n x m each). False if a coordinate is
/// not finite. O(m). \throws InputError as loop_pair
template <class DerivedX, class DerivedY>
[[nodiscard]] bool are_affine(const Eigen::MatrixBase<DerivedX>& X, const Eigen::MatrixBase<DerivedY>& Y,
                              double tolerance = 1e-12) {
    const auto pair = loop_pair(X, Y);
    return pair.finite() && affinity(pair).exact(tolerance);
}

/// \cond
#define PAVIOR_AFFINITY(prefix, Scalar, N) \
    prefix template Affinity<Scalar> affinity<Scalar, N>(const LoopPair<Scalar, N>&);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_AFFINITY, extern)
#endif
/// \endcond

}  // namespace pavior
