#pragma once
/// \file
/// The foldover-free continuation: minimise, lower epsilon, until nothing is inverted.

#include <pavior/core/progress.hpp>
#include <pavior/smooth/cell_energy.hpp>
#include <pavior/smooth/lbfgs.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pavior {

/// Limits of one continuation.
struct FoldoverOptions {
    int max_steps = 150;         ///< steps of epsilon
    int inner_iterations = 200;  ///< of L-BFGS per step
    double theta = 0.5;
};

struct FoldoverResult {
    bool valid = false;  ///< every determinant is positive
    int iterations = 0;  ///< of L-BFGS
};

/// Next epsilon of \cite garanzha2021 (theorem 1): with \p decrease = max(1/10, 1 - F_new / F_old) the determinants
/// become positive after finitely many steps if every step minimises well enough and a valid mesh exists.
[[nodiscard]] inline double next_epsilon(double epsilon, double min_det, double energy_before, double energy_after) {
    const double decrease = std::max(0.1, 1.0 - energy_after / energy_before);
    if (min_det >= 0.0) {
        return (1.0 - decrease) * epsilon;
    }
    const double root = std::hypot(min_det, epsilon);
    return (1.0 - decrease * root / (std::abs(min_det) + root)) * epsilon;
}

/// Moves x until every simplex of \p energy is positive and the distortion is near a minimum of its sum.
/// Energy: evaluate(x, mode, gradient) -> EnergyValue, diagonal(x, mode, result), refresh(x) before each step.
/// The last x is not valid if the result says so. Allocates nothing within a step of epsilon.
template <class Energy>
FoldoverResult minimise_foldover(Energy& energy, Eigen::VectorXd& x, const FoldoverOptions& options, Lbfgs& lbfgs) {
    FoldoverResult result;
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd diagonal(x.size());
    EnergyMode mode{1.0, options.theta, 0.0};
    double reference_det = -std::numeric_limits<double>::infinity();
    const auto step = [&](int iterations, double tolerance) {
        energy.diagonal(x, mode, diagonal);
        const auto value = [&](const Eigen::VectorXd& at, Eigen::VectorXd& slope) {
            return energy.evaluate(at, mode, slope).energy;
        };
        const LbfgsResult done = lbfgs.minimise(x, value, {iterations, tolerance, 1e-10}, diagonal);
        result.iterations += done.iterations;
    };
    energy.refresh(x);
    const double initial_det = energy.evaluate(x, mode, gradient).min_det;
    mode.epsilon = initial_det > 0.0 ? std::clamp(initial_det, 1e-3, 1.0) : std::max(1.0, -initial_det);
    for (int k = 0; k < options.max_steps; ++k) {
        energy.refresh(x);
        const double before = energy.evaluate(x, mode, gradient).energy;
        step(options.inner_iterations, 1e-4);
        const EnergyValue after = energy.evaluate(x, mode, gradient);
        if (after.min_det > 0.0 && after.energy > (1.0 - 1e-3) * before && mode.epsilon < 0.3 * after.min_det) {
            break;
        }
        if (k % 15 == 14) {
            if (after.min_det <= 0.0 && after.min_det < 0.95 * reference_det) {
                break;  // nothing gained for a long time: no valid mesh in reach
            }
            reference_det = after.min_det;
        }
        mode.epsilon = std::min(next_epsilon(mode.epsilon, after.min_det, before, after.energy),
                                std::max(1.0, -after.min_det));
        mode.epsilon = std::max(1e-9, mode.epsilon);
    }
    energy.refresh(x);
    result.valid = energy.evaluate(x, mode, gradient).min_det > 0.0;
    if (result.valid) {
        mode.epsilon = 0.0;
        step(options.inner_iterations, 1e-5);
    }
    return result;
}

/// Lowers the largest distortion of a valid x: minimises the sum of W / (1 - t W), t next to 1 / max W, again and again.
/// \param accept  called with every new x; true: go on.
template <class Energy, class Accept>
int minimise_largest_distortion(Energy& energy, Eigen::VectorXd& x, const FoldoverOptions& options, Lbfgs& lbfgs,
                                Accept&& accept) {
    int iterations = 0;
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd diagonal(x.size());
    EnergyMode mode{0.0, options.theta, 0.0};
    double largest = energy.evaluate(x, mode, gradient).max_distortion;
    for (int k = 0; k < 12; ++k) {
        mode.ceiling = 0.95 / largest;
        energy.diagonal(x, mode, diagonal);
        const auto value = [&](const Eigen::VectorXd& at, Eigen::VectorXd& slope) {
            return energy.evaluate(at, mode, slope).energy;
        };
        iterations += lbfgs.minimise(x, value, {options.inner_iterations, 1e-5, 1e-10}, diagonal).iterations;
        const double now = energy.evaluate(x, mode, gradient).max_distortion;
        if (!accept(x) || now > 0.99 * largest) {
            break;
        }
        largest = now;
    }
    return iterations;
}

}  // namespace pavior
