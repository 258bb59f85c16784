#pragma once

#include <pavior/mesh/quality.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

namespace pavior {

namespace detail {

PAVIOR_INLINE void Tally::add(double value, Index cell) {
    count_ += 1.0;
    const double delta = value - mean_;
    mean_ += delta / count_;
    squares_ += delta * (value - mean_);
    if (value < min_) {
        min_ = value;
        worst_ = cell;
    }
    max_ = std::max(max_, value);
    not_positive_ += value > 0.0 ? 0 : 1;
    const double at = std::floor((value - low_) / (high_ - low_) * static_cast<double>(histogram_.size()));
    ++histogram_[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(histogram_.size() - 1)))];
}

PAVIOR_INLINE void Tally::merge(const Tally& later) {
    const double total = count_ + later.count_;
    if (later.count_ == 0.0) {
        return;
    }
    const double delta = later.mean_ - mean_;
    squares_ += later.squares_ + delta * delta * count_ * later.count_ / total;
    mean_ += delta * later.count_ / total;
    count_ = total;
    if (later.min_ < min_) {
        min_ = later.min_;
        worst_ = later.worst_;
    }
    max_ = std::max(max_, later.max_);
    not_positive_ += later.not_positive_;
    std::transform(histogram_.begin(), histogram_.end(), later.histogram_.begin(), histogram_.begin(), std::plus<>());
}

PAVIOR_INLINE Statistics Tally::result() const {
    if (count_ == 0.0) {
        return {0, 0.0, 0.0, 0.0, 0.0, 0, low_, high_, histogram_};
    }
    return {static_cast<std::size_t>(count_),
            min_,
            max_,
            mean_,
            std::sqrt(squares_ / count_),
            worst_,
            low_,
            high_,
            histogram_};
}

PAVIOR_INLINE void require_size(std::size_t size, std::size_t cells) {
    if (size != cells) {
        throw InputError(ErrorCode::size_mismatch,
                         std::to_string(size) + " values for " + std::to_string(cells) + " cells");
    }
}

}  // namespace detail

}  // namespace pavior
