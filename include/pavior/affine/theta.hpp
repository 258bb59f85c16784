#pragma once
/// \file
/// The linear map Theta, which changes a linear map along one direction only; Lemma 2.8 \cite roca2009.

#include <pavior/core/error.hpp>

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace pavior {

/// Theta[A, uX, uY](v) = A v_H + lambda uY where v = v_H + lambda uX and <nX, v_H> = 0: it equals A on the hyperplane H
/// with unit normal \p nX and takes uX to uY. All vectors have n entries, \p A is n x n.
/// \throws InputError bad_option if uX lies in H up to rounding
template <class Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, N> theta(const Eigen::Matrix<Scalar, N, N>& A,
                                                const Eigen::Matrix<Scalar, N, 1>& uX,
                                                const Eigen::Matrix<Scalar, N, 1>& uY,
                                                const Eigen::Matrix<Scalar, N, 1>& nX) {
    const Scalar height = nX.dot(uX);
    if (!(std::abs(height) > 4 * std::numeric_limits<Scalar>::epsilon() * uX.stableNorm())) {
        throw InputError(ErrorCode::bad_option, "theta: uX lies in the hyperplane");
    }
    return A + (uY - A * uX) * (nX.transpose() / height);
}

}  // namespace pavior
