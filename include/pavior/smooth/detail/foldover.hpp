#pragma once
/// \file
/// The foldover-free continuation: minimise, lower epsilon, until nothing is inverted.

#include <pavior/core/progress.hpp>
#include <pavior/smooth/detail/cell_energy.hpp>
#include <pavior/smooth/lbfgs.hpp>
#include <pavior/smooth/options.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pavior::detail {

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

/// Next epsilon of \cite garanzha2021. With \p least_decrease = 1/10 the determinants become positive after finitely
/// many steps if every step minimises well enough and a valid mesh exists; after a converged step 3/10 will do.
[[nodiscard]] inline double next_epsilon(double epsilon, double min_det, double energy_before, double energy_after,
                                         double least_decrease = 0.1) {
    const double decrease = std::max(least_decrease, 1.0 - energy_after / energy_before);
    if (min_det >= 0.0) {
        return (1.0 - decrease) * epsilon;
    }
    const double root = std::hypot(min_det, epsilon);
    return (1.0 - decrease * root / (std::abs(min_det) + root)) * epsilon;
}

/// Tells, step by step of a continuation, that what is inverted will stay so.
class Stagnation {
public:
    /// \param converged  the step ended by itself
    [[nodiscard]] bool stuck(double epsilon, double min_det, bool converged) {
        const bool late = step_++ % 15 == 14;
        const bool flat = epsilon < -(converged ? 0.1 : 0.03) * min_det || epsilon < 1e-5;  // at best, in the end
        const bool idle = late && min_det < 0.95 * reference_;
        reference_ = late ? min_det : reference_;
        return min_det <= 0.0 && (flat || idle);
    }

private:
    int step_ = 0;
    double reference_ = -std::numeric_limits<double>::infinity();
};

/// Moves x until every simplex of \p energy is positive and the distortion is near a minimum of its sum.
/// Energy: evaluate(x, mode, gradient) -> EnergyValue, diagonal(x, mode, result), refresh(x) before each step, and
/// settle(x), which moves x to where its nodes may be.
/// The last x is not valid if the result says so. Allocates nothing within a step of epsilon.
template <class Energy>
FoldoverResult minimise_foldover(Energy& energy, Eigen::VectorXd& x, const FoldoverOptions& options, Lbfgs& lbfgs) {
    FoldoverResult result;
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd diagonal(x.size());
    EnergyMode mode{1.0, options.theta, 0.0};
    Stagnation stagnation;
    const auto step = [&](int iterations, double tolerance) {
        energy.diagonal(x, mode, diagonal);
        const auto value = [&](const Eigen::VectorXd& at, Eigen::VectorXd& slope) {
            return energy.evaluate(at, mode, slope).energy;
        };
        const LbfgsResult done = lbfgs.minimise(x, value, {iterations, tolerance, 1e-10}, diagonal);
        result.iterations += done.iterations;
        return done.iterations < iterations;
    };
    energy.refresh(x);
    const double initial_det = energy.evaluate(x, mode, gradient).min_det;
    mode.epsilon = initial_det > 0.0 ? std::clamp(initial_det, 1e-3, 1.0) : std::max(1.0, -initial_det);
    for (int k = 0; k < options.max_steps; ++k) {
        energy.refresh(x);
        const double before = energy.evaluate(x, mode, gradient).energy;
        const bool converged = step(options.inner_iterations, 1e-4);
        energy.settle(x);
        const EnergyValue after = energy.evaluate(x, mode, gradient);
        if (after.min_det > 0.0 && after.energy > (1.0 - 1e-3) * before && mode.epsilon < 0.3 * after.min_det) {
            break;
        }
        if (stagnation.stuck(mode.epsilon, after.min_det, converged)) {
            break;
        }
        mode.epsilon = std::min(next_epsilon(mode.epsilon, after.min_det, before, after.energy, converged ? 0.3 : 0.1),
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

/// Raises the smallest scaled determinant of a valid x by lowering the largest distortion: minimises the sum of
/// W / (1 - t W), t next to 1 / max W, again and again. x becomes the best point met, never one with a smaller minimum.
/// Energy: as for minimise_foldover(), and quality(x).
/// \param wanted  end as soon as the minimum reaches this.
/// \return iterations of L-BFGS; 0 if x is not valid.
template <class Energy>
int raise_minimum(Energy& energy, Eigen::VectorXd& x, double wanted, const FoldoverOptions& options, Lbfgs& lbfgs) {
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd diagonal(x.size());
    Eigen::VectorXd at = x;
    energy.settle(at);
    EnergyMode mode{0.0, options.theta, 0.0};
    EnergyValue now = energy.evaluate(at, mode, gradient);
    double best = energy.quality(x);
    int iterations = 0;
    for (int k = 0; k < 20 && now.min_det > 0.0 && best < wanted; ++k) {
        const double largest = now.max_distortion;
        mode.ceiling = 0.95 / largest;
        energy.diagonal(at, mode, diagonal);
        const auto value = [&](const Eigen::VectorXd& point, Eigen::VectorXd& slope) {
            return energy.evaluate(point, mode, slope).energy;
        };
        iterations += lbfgs.minimise(at, value, {options.inner_iterations, 1e-4, 1e-10}, diagonal).iterations;
        energy.settle(at);
        now = energy.evaluate(at, mode, gradient);
        const double quality = energy.quality(at);
        if (quality > best) {
            best = quality;
            x = at;
        }
        if (now.max_distortion > 0.99 * largest) {
            break;
        }
    }
    return iterations;
}

/// Untangles x, then raises the minimum until it reaches \p wanted. A valid x stays valid and
/// never gets a smaller minimum. \return iterations of L-BFGS.
template <class Energy>
int solve_patch(Energy& energy, Eigen::VectorXd& x, double wanted, const FoldoverOptions& options, Lbfgs& lbfgs) {
    Eigen::VectorXd gradient(x.size());
    energy.refresh(x);
    const bool valid = energy.evaluate(x, EnergyMode{0.0, options.theta, 0.0}, gradient).min_det > 0.0;
    Eigen::VectorXd fresh = x;
    const FoldoverResult result = minimise_foldover(energy, fresh, options, lbfgs);
    int iterations = result.iterations;
    if (result.valid) {
        iterations += raise_minimum(energy, fresh, wanted, options, lbfgs);
    }
    if (valid && (!result.valid || energy.quality(fresh) < energy.quality(x))) {
        return iterations + raise_minimum(energy, x, wanted, options, lbfgs);
    }
    x = fresh;
    return iterations;
}

/// The whole of one attempt: solve_patch() from where the nodes of \p energy are, then write(x) if x has moved.
/// \return iterations of L-BFGS.
template <class Energy, class Write>
int move_patch(Energy& energy, double wanted, const UntangleOptions& options, Write&& write) {
    const Eigen::VectorXd start = energy.free_nodes();
    Eigen::VectorXd x = start;
    Lbfgs lbfgs;
    const FoldoverOptions limits{options.max_iterations, options.inner_iterations, options.theta};
    const int iterations = solve_patch(energy, x, wanted, limits, lbfgs);
    if (x != start) {
        write(x);
    }
    return iterations;
}

}  // namespace pavior::detail
