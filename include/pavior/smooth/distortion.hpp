#pragma once
/// \file
/// The regularised distortion of one simplex, with its derivative.

#include <Eigen/Core>

#include <cmath>

namespace pavior {

/// chi(eps, det) = (det + sqrt(eps^2 + det^2)) / 2 > 0, \cite garanzha2021: next to det where det >> eps,
/// next to eps^2 / (4 |det|) where det << -eps. Computed without cancellation; det itself for eps = 0 and det > 0.
[[nodiscard]] inline double foldover_chi(double epsilon, double det) {
    const double root = std::sqrt(epsilon * epsilon + det * det);
    return det > 0.0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
}

/// Matrix of cofactors: the derivative of det(J) by J. J is 2x2 or 3x3.
template <int D>
[[nodiscard]] Eigen::Matrix<double, D, D> cofactors(const Eigen::Matrix<double, D, D>& J) {
    static_assert(D == 2 || D == 3);
    Eigen::Matrix<double, D, D> K;
    if constexpr (D == 2) {
        K << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);
    } else {
        for (int c = 0; c < 3; ++c) {
            const int a = (c + 1) % 3;
            const int b = (c + 2) % 3;
            K(0, c) = J(1, a) * J(2, b) - J(2, a) * J(1, b);
            K(1, c) = J(2, a) * J(0, b) - J(0, a) * J(2, b);
            K(2, c) = J(0, a) * J(1, b) - J(1, a) * J(0, b);
        }
    }
    return K;
}

/// Value of the distortion, the determinant it belongs to and the second derivatives that a preconditioner wants.
struct Distortion {
    double value = 0.0;
    double det = 0.0;
    double shape_curvature = 0.0;  ///< d2/d|J|^2 of the shape term, the determinant held
    double det_curvature = 0.0;    ///< convex part of the second derivative by the determinant
};

/// W(J) = (tr(J^T J) / chi^(2/d) + theta (1 + det^2) / chi) / (d + 2 theta), chi = chi(epsilon, det J): 1 for
/// rotations, at least 1 for det J > 0 and epsilon = 0, \cite garanzha2021.
/// \param J           d x d Jacobian, d = 2 or 3, from the ideal to the actual simplex.
/// \param epsilon     >= 0; > 0 if det J may be <= 0.
/// \param derivative  dW/dJ, d x d.
template <int D>
[[nodiscard]] Distortion distortion(const Eigen::Matrix<double, D, D>& J, double epsilon, double theta,
                                    Eigen::Matrix<double, D, D>& derivative) {
    const Eigen::Matrix<double, D, D> K = cofactors<D>(J);
    const double det = J.col(0).dot(K.col(0));
    const double root = std::sqrt(epsilon * epsilon + det * det);
    const double chi = foldover_chi(epsilon, det);
    const double chi_slope = root > 0.0 ? chi / root : 1.0;
    const double power = D == 2 ? chi : std::cbrt(chi) * std::cbrt(chi);
    const double scale = 1.0 / (D + 2.0 * theta);
    const double shape = scale * J.squaredNorm() / power;
    const double volume = scale * theta * (1.0 + det * det) / chi;
    const double relative = chi_slope / chi;
    const double by_det = 2.0 * scale * theta * det / chi - (2.0 / D * shape + volume) * relative;
    derivative = (2.0 * scale / power) * J + by_det * K;
    constexpr double exponent = 2.0 / D;
    return {shape + volume, det, 2.0 * scale / power,
            (exponent * (exponent + 1.0) * shape + 2.0 * volume) * relative * relative + 2.0 * scale * theta / chi};
}

}  // namespace pavior
