#pragma once
/// \file
/// What every affine fit takes and returns besides the loops.

#include <pavior/core/error.hpp>
#include <pavior/math/affine_map.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

namespace pavior {

/// Outcome of a fit.
enum class FitStatus : std::uint8_t {
    ok,
    null_pseudo_area,   ///< a loop encloses no area: it has no pseudo-normal
    source_degenerate,  ///< the source spans less than a hyperplane
    target_degenerate,  ///< the target spans less than a hyperplane
    unrelated_loops,    ///< no correlation between the loops along some direction: the map would collapse
    not_finite,         ///< NaN or infinite coordinates, or arithmetic that overflowed
};

/// The stable name of \p status.
[[nodiscard]] constexpr std::string_view to_string(FitStatus status) noexcept {
    switch (status) {
        case FitStatus::ok: return "ok";
        case FitStatus::null_pseudo_area: return "null_pseudo_area";
        case FitStatus::source_degenerate: return "source_degenerate";
        case FitStatus::target_degenerate: return "target_degenerate";
        case FitStatus::unrelated_loops: return "unrelated_loops";
        case FitStatus::not_finite: return "not_finite";
    }
    return "unknown";
}

/// The error code that a caller who cannot go on should throw. \pre status != ok
[[nodiscard]] constexpr ErrorCode to_error_code(FitStatus status) noexcept {
    switch (status) {
        case FitStatus::null_pseudo_area: return ErrorCode::null_pseudo_area;
        case FitStatus::source_degenerate: return ErrorCode::source_degenerate;
        case FitStatus::target_degenerate: return ErrorCode::target_degenerate;
        case FitStatus::unrelated_loops: return ErrorCode::unrelated_loops;
        case FitStatus::ok:
        case FitStatus::not_finite: break;
    }
    return ErrorCode::not_finite;
}

/// Relative tolerances. All of them are raised to the rounding level of the coordinates, which grows with the distance
/// from the origin and is larger for float.
struct FitOptions {
    /// f, g, h: a singular value w counts as zero if w <= zero_singular_value * w_1.
    double zero_singular_value = 1e-8;
    /// constrained: a loop is degenerate if sigma_(n-1) <= degenerate * sigma_1 of its projection along the normal.
    double degenerate = 1e-11;
    /// A pseudo-area is null if |a| <= null_pseudo_area * scale (pseudo_area.hpp).
    double null_pseudo_area = 1e-10;
    /// Loops are unrelated along a direction if their canonical correlation there is below this.
    double unrelated = 1e-8;
    /// h: the kernel or cokernel counts as ambiguous if |cos| of its angle with the pseudo-normal is below this.
    double ambiguous_cosine = 1e-6;
};

/// An affine map fitted to a pair of loops, with its report. Unless stated otherwise the map is set only if
/// `status == ok`; f and g set it whenever the coordinates are finite. Elsewhere its entries are NaN.
template <class Scalar, int N>
struct AffineFit {
    using Vector = Eigen::Matrix<Scalar, N, 1>;

    AffineMap<Scalar, N> map;
    FitStatus status = FitStatus::ok;
    bool at_target = false;         ///< null_pseudo_area, not_finite: the target loop is at fault, else the source loop
    bool ambiguous_normal = false;  ///< h: a direction is perpendicular to its pseudo-normal, its sign is arbitrary
    int rank = 0;                   ///< f, h: numerical rank of the centred source; g: of the source moved to cY - cX;
                                    ///< constrained: rank of the linear part, n if ok
    Scalar residual = 0;            ///< max_i |y_i - phi(x_i)|, unit of the coordinates
    Scalar correlation = 0;         ///< smallest of the n - 1 largest canonical correlations of the loops, in [0, 1]
    Vector uX;                      ///< the vector mapped to uY: pseudo-normals or kernels (unit), g: cY - cX, f: zero
    Vector uY;
};

namespace detail {

/// Canonical correlations at or below this are zero.
template <class Scalar>
[[nodiscard]] Scalar unrelated_threshold(const FitOptions& options) {
    return std::max(static_cast<Scalar>(options.unrelated), 64 * std::numeric_limits<Scalar>::epsilon());
}

/// A fit whose map is NaN throughout.
template <class Scalar, int N>
[[nodiscard]] AffineFit<Scalar, N> unfitted(Eigen::Index n) {
    using Vector = Eigen::Matrix<Scalar, N, 1>;
    constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    AffineFit<Scalar, N> fit;
    fit.map = {Eigen::Matrix<Scalar, N, N>::Constant(n, n, nan), Vector::Constant(n, nan), Vector::Constant(n, nan)};
    fit.residual = nan;
    fit.uX = Vector::Zero(n);
    fit.uY = Vector::Zero(n);
    return fit;
}

}  // namespace detail
}  // namespace pavior
