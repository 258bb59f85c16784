#pragma once

#include <pavior/smooth/lbfgs.hpp>

#include <algorithm>
#include <cstddef>

namespace pavior {

PAVIOR_INLINE void Lbfgs::resize(Eigen::Index n) {
    if (gradient_.size() == n) {
        return;
    }
    for (Eigen::VectorXd* vector : {&gradient_, &direction_, &trial_, &trial_gradient_}) {
        vector->resize(n);
    }
    steps_.resize(n, memory_);
    yields_.resize(n, memory_);
    curvature_.resize(static_cast<std::size_t>(memory_));
    alpha_.resize(static_cast<std::size_t>(memory_));
}

PAVIOR_INLINE void Lbfgs::direction() {
    direction_ = -gradient_;
    const int used = std::min(count_, memory_);
    for (int k = 1; k <= used; ++k) {
        const int slot = (count_ - k) % memory_;
        alpha_[at(slot)] = steps_.col(slot).dot(direction_) / curvature_[at(slot)];
        direction_.noalias() -= alpha_[at(slot)] * yields_.col(slot);
    }
    direction_.array() *= scale_if(used > 0) * inverse_diagonal_.array();
    for (int k = used; k >= 1; --k) {
        const int slot = (count_ - k) % memory_;
        const double beta = yields_.col(slot).dot(direction_) / curvature_[at(slot)];
        direction_.noalias() += (alpha_[at(slot)] - beta) * steps_.col(slot);
    }
    if (!(direction_.dot(gradient_) < 0.0)) {
        count_ = 0;
        direction_ = -(inverse_diagonal_.array() * gradient_.array()).matrix();
    }
}

PAVIOR_INLINE void Lbfgs::accept(Eigen::VectorXd& x, double& value, double trial_value) {
    const int slot = count_ % memory_;
    steps_.col(slot) = trial_ - x;
    yields_.col(slot) = trial_gradient_ - gradient_;
    const double sy = steps_.col(slot).dot(yields_.col(slot));
    const double yy = (yields_.col(slot).array().square() * inverse_diagonal_.array()).sum();
    if (sy > 1e-300 && sy > 1e-14 * yy) {
        curvature_[at(slot)] = sy;
        scale_ = sy / yy;
        ++count_;
    }
    x.swap(trial_);
    gradient_.swap(trial_gradient_);
    value = trial_value;
}

}  // namespace pavior
