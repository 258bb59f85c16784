#pragma once

#include <pavior/sweep/spacing.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE Spacing Spacing::uniform(std::size_t n) {
    require_intervals(n);
    std::vector<double> t(n + 1);
    for (std::size_t i = 0; i <= n; ++i) {
        t[i] = static_cast<double>(i) / static_cast<double>(n);
    }
    return Spacing(std::move(t));
}

PAVIOR_INLINE Spacing Spacing::geometric(std::size_t n, double ratio) {
    require_intervals(n);
    if (!(ratio > 0.0) || !std::isfinite(ratio)) {
        throw InputError(ErrorCode::bad_option, "the ratio of a geometric spacing must be positive and finite");
    }
    if (ratio == 1.0) {
        return uniform(n);
    }
    if (ratio > 1.0) {
        return geometric(n, 1.0 / ratio).reversed();
    }
    const double rate = std::log(ratio);
    const double total = std::expm1(static_cast<double>(n) * rate);
    std::vector<double> t(n + 1);
    for (std::size_t i = 0; i <= n; ++i) {
        t[i] = std::expm1(static_cast<double>(i) * rate) / total;
    }
    return checked(std::move(t), "a geometric spacing with this ratio has coinciding positions");
}

PAVIOR_INLINE Spacing Spacing::given(std::vector<double> positions) {
    if (positions.size() < 2 || positions.front() != 0.0 || positions.back() != 1.0) {
        throw InputError(ErrorCode::bad_option, "positions must start at 0 and end at 1");
    }
    return checked(std::move(positions), "positions must increase strictly");
}

PAVIOR_INLINE Spacing Spacing::reversed() const {
    std::vector<double> t(positions_.size());
    for (std::size_t i = 0; i < t.size(); ++i) {
        t[i] = 1.0 - positions_[t.size() - 1 - i];
    }
    return checked(std::move(t), "the reversed spacing has coinciding positions");
}

PAVIOR_INLINE Spacing Spacing::checked(std::vector<double> positions, const char* message) {
    Error::Ids bad;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        if (!(positions[i - 1] < positions[i])) {
            bad.push_back(static_cast<std::int64_t>(i));
        }
    }
    if (!bad.empty()) {
        throw InputError(ErrorCode::bad_option, message, std::move(bad));
    }
    return Spacing(std::move(positions));
}

}  // namespace pavior
