#pragma once
/// \file
/// Limited-memory quasi-Newton minimiser with a diagonal preconditioner.

#include <pavior/core/compiled.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pavior {

/// When Lbfgs::minimise() ends.
struct LbfgsOptions {
    int max_iterations = 200;           ///< >= 0
    double relative_decrease = 1e-5;    ///< end when 5 iterations together lower f by less than this times |f|
    double gradient_tolerance = 1e-10;  ///< end when max |g_i| is not above this
};

struct LbfgsResult {
    double value = 0.0;
    int iterations = 0;
    int evaluations = 0;  ///< calls of f
};

/// L-BFGS (two-loop recursion) with a weak Wolfe line search by bracketing and safeguarded interpolation. The function
/// may return infinity or NaN outside its domain: the search backs off, so that every accepted point lies inside.
/// Keeps its workspace: minimise() allocates only when the number of variables grows. Deterministic, one thread.
class Lbfgs {
public:
    explicit Lbfgs(int memory = 8) : memory_(std::max(1, memory)) {}

    /// Minimises f from \p x, which is replaced by the best point found; never a point with larger f.
    /// \param f          double f(const Eigen::VectorXd& x, Eigen::VectorXd& gradient), finite at the initial \p x.
    /// \param diagonal   positive estimate of the diagonal of the Hessian, as long as x, or empty for the identity.
    /// \return f at the new x and the iterations done. O(memory * n) per iteration and about one call of f.
    template <class Function>
    LbfgsResult minimise(Eigen::VectorXd& x, Function&& f, const LbfgsOptions& options = {},
                         const Eigen::VectorXd& diagonal = {}) {
        resize(x.size());
        inverse_diagonal_ = Eigen::VectorXd::Ones(x.size());
        if (diagonal.size() == x.size()) {
            inverse_diagonal_ = diagonal.cwiseInverse();
        }
        LbfgsResult result{f(x, gradient_), 0, 1};
        std::array<double, 5> past;
        past.fill(std::numeric_limits<double>::infinity());
        count_ = 0;
        while (result.iterations < options.max_iterations &&
               gradient_.lpNorm<Eigen::Infinity>() > options.gradient_tolerance) {
            direction();
            if (!search(x, f, result)) {
                if (count_ == 0) {
                    break;
                }
                count_ = 0;  // the model is of no use here: start again from the preconditioned gradient
                continue;
            }
            double& old = past[static_cast<std::size_t>(result.iterations++) % past.size()];
            const bool stalled = old - result.value < options.relative_decrease * std::abs(result.value);
            old = result.value;
            if (stalled) {
                break;
            }
        }
        return result;
    }

private:
    void resize(Eigen::Index n);

    /// direction_ = -H gradient_.
    void direction();

    [[nodiscard]] double scale_if(bool has_history) const { return has_history ? scale_ : 1.0; }
    [[nodiscard]] static std::size_t at(int slot) { return static_cast<std::size_t>(slot); }

    /// Moves x, the value and gradient_ along direction_; false if no decrease was found (nothing is changed then).
    template <class Function>
    bool search(Eigen::VectorXd& x, Function& f, LbfgsResult& result) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double value = result.value;
        const double slope = gradient_.dot(direction_);
        double low = 0.0;
        double high = infinity;
        double step = 1.0;
        for (int attempt = 0; attempt < 40; ++attempt) {
            trial_.noalias() = x + step * direction_;
            const double trial_value = f(trial_, trial_gradient_);
            ++result.evaluations;
            if (!(trial_value <= value + 1e-4 * step * slope)) {
                high = step;
                const double curve = trial_value - value - step * slope;
                const double guess = std::isfinite(curve) && low == 0.0 ? -0.5 * slope * step * step / curve : 0.0;
                step = low == 0.0 ? std::clamp(guess, 0.1 * step, 0.5 * step) : 0.5 * (low + high);
            } else if (high - low > 1e-3 * step && attempt < 20 && trial_gradient_.dot(direction_) < 0.9 * slope) {
                low = step;
                step = high == infinity ? 2.0 * step : 0.5 * (low + high);
            } else {
                accept(x, result.value, trial_value);
                return true;
            }
        }
        return false;
    }

    void accept(Eigen::VectorXd& x, double& value, double trial_value);

    int memory_;
    int count_ = 0;
    double scale_ = 1.0;
    Eigen::VectorXd gradient_, direction_, trial_, trial_gradient_, inverse_diagonal_;
    Eigen::MatrixXd steps_, yields_;
    std::vector<double> curvature_, alpha_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/lbfgs-inl.hpp>
#endif
