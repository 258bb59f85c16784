#pragma once
/// \file
/// Points brought to the origin and to size 1 without losing digits.

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pavior {

/// Points as columns, read in place where a Matrix, Map or Block holds them column by column; other expressions are
/// evaluated first.
template <class Scalar, int N>
using PointsRef = Eigen::Ref<const Eigen::Matrix<Scalar, N, Eigen::Dynamic>>;

/// Local coordinates of a set of points: local(x) = (x - c) / scale with c the geometric centre (2.2) \cite roca2009.
/// The scale is a power of two, so that scaling rounds nothing; coordinates from 1e-200 to 1e200 are safe.
template <class Scalar, int N>
struct Centring {
    using Vector = Eigen::Matrix<Scalar, N, 1>;

    Vector centre;      ///< the geometric centre, rounded to the precision of the coordinates
    Vector shift;       ///< what the rounding left of it, in units of `scale`
    Scalar scale = 1;   ///< power of two within a factor 2 above max_i |x_i - c|_inf; 1 if all points coincide
    Scalar extent = 0;  ///< max_i |x_i|_inf: the rounding error of a coordinate is about epsilon times this
    bool finite = true;

    /// (x - c) / scale.
    template <class Derived>
    [[nodiscard]] Vector local(const Eigen::MatrixBase<Derived>& x) const {
        return (x - centre) * (Scalar(1) / scale) - shift;
    }

    /// Rounding error of one local coordinate, times sqrt(m): the noise level of the singular values of m points.
    [[nodiscard]] Scalar noise(Eigen::Index m) const {
        return std::numeric_limits<Scalar>::epsilon() * std::sqrt(static_cast<Scalar>(m)) * (extent / scale);
    }
};

namespace detail {

/// The power of two in (value, 2 value], kept where it and its inverse are normal numbers; 1 for 0.
template <class Scalar>
[[nodiscard]] Scalar power_of_two_near(Scalar value) {
    if (!(value > Scalar(0))) {
        return Scalar(1);
    }
    int exponent = 0;
    std::frexp(value, &exponent);
    constexpr int limit = std::numeric_limits<Scalar>::max_exponent - 2;
    return std::ldexp(Scalar(1), std::clamp(exponent, -limit, limit));
}

}  // namespace detail

/// Centre and scale of the columns of \p X (n x m, m >= 1); O(m). `finite` is false, and the rest meaningless, if a
/// coordinate is not finite or the differences overflow.
template <class Scalar, int N>
[[nodiscard]] Centring<Scalar, N> centring(PointsRef<Scalar, N> X) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    Centring<Scalar, N> result;
    const Scalar count = static_cast<Scalar>(X.cols());
    result.extent = X.cwiseAbs().maxCoeff();
    result.centre = Vector::Zero(X.rows());
    result.shift = Vector::Zero(X.rows());
    result.finite = X.allFinite();
    if (!result.finite) {
        return result;
    }
    const Scalar unit = detail::power_of_two_near(result.extent);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        result.centre += X.col(i) * (Scalar(1) / unit);
    }
    result.centre *= unit / count;
    Scalar radius = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        radius = std::max(radius, (X.col(i) - result.centre).cwiseAbs().maxCoeff());
    }
    result.scale = detail::power_of_two_near(radius);
    Vector shift = result.shift;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        shift += result.local(X.col(i));
    }
    result.shift = shift / count;
    result.finite = std::isfinite(radius) && result.shift.allFinite();
    return result;
}

/// The same for any matrix expression with the points as columns.
template <class Derived>
[[nodiscard]] auto centring(const Eigen::MatrixBase<Derived>& X) {
    return centring<typename Derived::Scalar, Derived::RowsAtCompileTime>(X.derived());
}

/// \cond
/// The scalars and dimensions that pavior::compiled holds of every template of affine/.
#define PAVIOR_AFFINE_SIZES(apply, prefix) \
    apply(prefix, double, 2) apply(prefix, double, 3) apply(prefix, double, Eigen::Dynamic)
#define PAVIOR_CENTRING(prefix, Scalar, N) \
    prefix template Centring<Scalar, N> centring<Scalar, N>(PointsRef<Scalar, N>);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_CENTRING, extern)
#endif
/// \endcond

}  // namespace pavior
