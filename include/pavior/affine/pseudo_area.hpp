#pragma once
/// \file
/// Pseudo-area and pseudo-normal of loops and multi-loops; Section 3.3.1 \cite roca2009.

#include <pavior/affine/centring.hpp>
#include <pavior/affine/detail/point_columns.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>
#include <pavior/math/small_svd.hpp>
#include <pavior/math/streamed_qr.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

namespace pavior {

/// Pseudo-area of a multi-loop in local coordinates, and the scale it is to be compared with.
template <class Scalar, int N>
struct Enclosure {
    Eigen::Matrix<Scalar, N, 1> area;  ///< n = 3: divided by the square of the scale of the centring; n = 2: by it
    Scalar bound = 0;  ///< n = 3: half the sum of |x_i - c| |x_(i+1) - x_i|; n = 2: length of the curves
};

/// The unit vector along a pseudo-area, if there is one.
template <class Scalar, int N>
struct PseudoNormal {
    Eigen::Matrix<Scalar, N, 1> normal;  ///< unit, or zero if null
    Scalar relative_area = 0;            ///< |pseudo-area| / scale: 1 for a circle, 0 for a figure eight
    bool null = true;
};

/// \throws InputError bad_index if \p offsets is not 0 = o_0 <= o_1 <= ... <= o_p = \p m with p >= 1
PAVIOR_INLINE void verify_loop_offsets(std::span<const std::size_t> offsets, std::size_t m);

namespace detail {

template <class Scalar, int N>
void add_curve(Enclosure<Scalar, N>& sum, const Eigen::Matrix<Scalar, N, 1>& from,
               const Eigen::Matrix<Scalar, N, 1>& to, bool closing) {
    if (from.size() == 3) {
        const Eigen::Matrix<Scalar, N, 1> edge = to - from;
        sum.area(0) += (from(1) * edge(2) - from(2) * edge(1)) / 2;
        sum.area(1) += (from(2) * edge(0) - from(0) * edge(2)) / 2;
        sum.area(2) += (from(0) * edge(1) - from(1) * edge(0)) / 2;
        sum.bound += from.norm() * edge.norm() / 2;
    } else if (!closing) {
        sum.area(0) -= to(1) - from(1);
        sum.area(1) += to(0) - from(0);
        sum.bound += (to - from).norm();
    }
}

}  // namespace detail

/// Pseudo-area of the columns of \p X (n x m, n = 2 or 3) in the local coordinates \p local. n = 3: half the sum of
/// (x_i - c) x (x_(i+1) - c) over closed loops, Definition 3.3. n = 2, open curves: the chord from the first to the
/// last point of each, turned by +90 degrees. O(m), no heap for fixed n.
template <class Scalar, int N>
[[nodiscard]] Enclosure<Scalar, N> enclosure(PointsRef<Scalar, N> X, std::span<const std::size_t> offsets,
                                             const Centring<Scalar, N>& local) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    Enclosure<Scalar, N> sum{Vector::Zero(X.rows()), Scalar(0)};
    for (std::size_t loop = 0; loop + 1 < offsets.size(); ++loop) {
        const auto first = static_cast<Eigen::Index>(offsets[loop]);
        const auto last = static_cast<Eigen::Index>(offsets[loop + 1]);
        if (first == last) {
            continue;
        }
        Vector from = local.local(X.col(last - 1));
        for (Eigen::Index i = first; i < last; ++i) {
            const Vector to = local.local(X.col(i));
            detail::add_curve<Scalar, N>(sum, from, to, i == first);
            from = to;
        }
    }
    return sum;
}

/// The same for any matrix expression with the points as columns.
template <class Derived, class Scalar, int N>
[[nodiscard]] Enclosure<Scalar, N> enclosure(const Eigen::MatrixBase<Derived>& X, std::span<const std::size_t> offsets,
                                             const Centring<Scalar, N>& local) {
    return enclosure<Scalar, N>(PointsRef<Scalar, N>(X.derived()), offsets, local);
}

/// The direction of \p sum. It is null if |area| is not above \p tolerance times the bound, or not above the rounding
/// error of the coordinates.
template <class Scalar, int N>
[[nodiscard]] PseudoNormal<Scalar, N> pseudo_normal(const Enclosure<Scalar, N>& sum, const Centring<Scalar, N>& local,
                                                    double tolerance = 1e-10) {
    const Scalar rounding =
        4 * std::numeric_limits<Scalar>::epsilon() * std::max(Scalar(1), local.extent / local.scale);
    const Scalar length = sum.area.norm();
    PseudoNormal<Scalar, N> result{Eigen::Matrix<Scalar, N, 1>::Zero(sum.area.size()), Scalar(0), true};
    if (!(length > std::max(static_cast<Scalar>(tolerance), rounding) * sum.bound)) {
        return result;
    }
    return {sum.area / length, length / sum.bound, false};
}

/// The normal of a set with the decomposition \p svd of its local coordinates, for n >= 4, where closed curves enclose
/// no hyperarea: it exists (`null` is false) only if the set is hyperplanar, w_n <= \p threshold < w_(n-1). Its sign is
/// arbitrary: the largest component is positive.
template <class Scalar, int R, int N>
[[nodiscard]] PseudoNormal<Scalar, N> hyperplane_normal(const SmallSvd<Scalar, R, N>& svd, Scalar threshold) {
    const Eigen::Index n = svd.w.size();
    PseudoNormal<Scalar, N> result{Eigen::Matrix<Scalar, N, 1>::Zero(n), Scalar(0), true};
    if (svd.rank(threshold) != n - 1) {
        return result;
    }
    Eigen::Index largest = 0;
    result.normal = svd.V.col(n - 1);
    result.normal.cwiseAbs().maxCoeff(&largest);
    result.normal *= result.normal(largest) < 0 ? Scalar(-1) : Scalar(1);
    result.relative_area = 1;
    result.null = false;
    return result;
}

/// Pseudo-area of the multi-loop with points \p X (columns, n x m, n = 2 or 3) and loops
/// offsets[l] .. offsets[l + 1] - 1, in the user's unit squared (n = 2: unit). Precise far from the origin
/// (Proposition 3.4 (i) with the centre subtracted). Overflows to infinity above about 1e150.
/// \throws InputError empty_input, bad_index (offsets), bad_option (n >= 4)
template <class Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> pseudo_area(PointsRef<Scalar, N> X, std::span<const std::size_t> offsets) {
    static_assert(N == Eigen::Dynamic || N == 2 || N == 3, "pseudo-areas exist in two and three dimensions");
    verify_loop_offsets(offsets, static_cast<std::size_t>(X.cols()));
    if (X.cols() == 0) {
        throw InputError(ErrorCode::empty_input, "pseudo-area: no points");
    }
    if (X.rows() != 2 && X.rows() != 3) {
        throw InputError(ErrorCode::bad_option, "pseudo-areas exist in two and three dimensions");
    }
    const Centring<Scalar, N> local = centring<Scalar, N>(X);
    Enclosure<Scalar, N> sum = enclosure<Scalar, N>(X, offsets, local);
    for (Eigen::Index power = 1; power < X.rows(); ++power) {
        sum.area *= local.scale;
    }
    return sum.area;
}

/// The same for any matrix expression with the points as columns.
template <class Derived>
[[nodiscard]] auto pseudo_area(const Eigen::MatrixBase<Derived>& X, std::span<const std::size_t> offsets) {
    return pseudo_area<typename Derived::Scalar, Derived::RowsAtCompileTime>(X.derived(), offsets);
}

/// The same for a point_range, read in place where the points are doubles in memory.
template <point_range R>
[[nodiscard]] Vec3 pseudo_area(const R& points, std::span<const std::size_t> offsets) {
    const detail::PointColumns X(points);
    return pseudo_area(X.matrix(), offsets);
}

/// Pseudo-normal of the multi-loop, Definition 3.6; n >= 4: hyperplane_normal. Null for figure eights, collinear
/// points, closed plane curves (n = 2) and coordinates that are not finite. O(m).
/// \throws InputError empty_input, bad_index (offsets)
template <class Scalar, int N>
[[nodiscard]] PseudoNormal<Scalar, N> pseudo_normal(PointsRef<Scalar, N> X, std::span<const std::size_t> offsets,
                                                    double tolerance = 1e-10) {
    verify_loop_offsets(offsets, static_cast<std::size_t>(X.cols()));
    if (X.cols() == 0) {
        throw InputError(ErrorCode::empty_input, "pseudo-normal: no points");
    }
    const Eigen::Index n = X.rows();
    const Centring<Scalar, N> local = centring<Scalar, N>(X);
    if (!local.finite || n < 2) {
        return {Eigen::Matrix<Scalar, N, 1>::Zero(n), Scalar(0), true};
    }
    if (n <= 3) {
        return pseudo_normal<Scalar, N>(enclosure<Scalar, N>(X, offsets, local), local, tolerance);
    }
    StreamedQr<Scalar, N> qr(n);
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
        qr.add(local.local(X.col(i)).transpose());
    }
    const auto svd = small_svd(qr.factor());
    return hyperplane_normal(svd, std::max(Scalar(1e-8) * svd.w(0), 16 * local.noise(X.cols())));
}

/// The same for any matrix expression with the points as columns.
template <class Derived>
[[nodiscard]] auto pseudo_normal(const Eigen::MatrixBase<Derived>& X, std::span<const std::size_t> offsets,
                                 double tolerance = 1e-10) {
    return pseudo_normal<typename Derived::Scalar, Derived::RowsAtCompileTime>(
        PointsRef<typename Derived::Scalar, Derived::RowsAtCompileTime>(X.derived()), offsets, tolerance);
}

/// The same for a point_range, read in place where the points are doubles in memory.
template <point_range R>
[[nodiscard]] PseudoNormal<double, 3> pseudo_normal(const R& points, std::span<const std::size_t> offsets,
                                                    double tolerance = 1e-10) {
    const detail::PointColumns X(points);
    return pseudo_normal(X.matrix(), offsets, tolerance);
}

/// \cond
#define PAVIOR_PSEUDO_AREA(prefix, Scalar, N)                                                \
    prefix template Eigen::Matrix<Scalar, N, 1> pseudo_area<Scalar, N>(PointsRef<Scalar, N>, \
                                                                       std::span<const std::size_t>);
#define PAVIOR_PSEUDO_NORMAL(prefix, Scalar, N)                                                                   \
    prefix template Enclosure<Scalar, N> enclosure<Scalar, N>(PointsRef<Scalar, N>, std::span<const std::size_t>, \
                                                              const Centring<Scalar, N>&);                        \
    prefix template PseudoNormal<Scalar, N> pseudo_normal<Scalar, N>(const Enclosure<Scalar, N>&,                 \
                                                                     const Centring<Scalar, N>&, double);         \
    prefix template PseudoNormal<Scalar, N> pseudo_normal<Scalar, N>(PointsRef<Scalar, N>,                        \
                                                                     std::span<const std::size_t>, double);
#ifdef PAVIOR_COMPILED
PAVIOR_AFFINE_SIZES(PAVIOR_PSEUDO_NORMAL, extern)
PAVIOR_PSEUDO_AREA(extern, double, 2)
PAVIOR_PSEUDO_AREA(extern, double, 3)
PAVIOR_PSEUDO_AREA(extern, double, Eigen::Dynamic)
#endif
/// \endcond

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/affine/pseudo_area-inl.hpp>
#endif
