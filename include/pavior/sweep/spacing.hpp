#pragma once
/// \file
/// Positions of the levels of a sweep, or of the nodes of an edge, in [0, 1].

#include <pavior/core/error.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Positions 0 = t_0 < t_1 < ... < t_n = 1 of n >= 1 intervals; t_0 and t_n are exact. A value type, O(n) to make.
/// A default Spacing is one interval.
class Spacing {
public:
    Spacing() : positions_{0.0, 1.0} {}

    /// t_i = i / n, correctly rounded. n = 0 is an InputError (bad_option).
    [[nodiscard]] static Spacing uniform(std::size_t n) {
        require_intervals(n);
        std::vector<double> t(n + 1);
        for (std::size_t i = 0; i <= n; ++i) {
            t[i] = static_cast<double>(i) / static_cast<double>(n);
        }
        return Spacing(std::move(t));
    }

    /// Each interval is \p ratio times as long as the one before; ratio 1 gives uniform(n).
    /// InputError (bad_option) if n = 0, if the ratio is not positive and finite, or if it is so far from 1 that two
    /// positions coincide in double precision.
    [[nodiscard]] static Spacing geometric(std::size_t n, double ratio) {
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

    /// The caller's positions. InputError (bad_option, with the ids of the positions) unless they start at 0, end at 1
    /// and increase strictly.
    [[nodiscard]] static Spacing given(std::vector<double> positions) {
        if (positions.size() < 2 || positions.front() != 0.0 || positions.back() != 1.0) {
            throw InputError(ErrorCode::bad_option, "positions must start at 0 and end at 1");
        }
        return checked(std::move(positions), "positions must increase strictly");
    }

    [[nodiscard]] std::size_t intervals() const { return positions_.size() - 1; }
    [[nodiscard]] std::span<const double> positions() const { return positions_; }
    [[nodiscard]] double operator[](std::size_t i) const { return positions_[i]; }

    /// The same intervals from the other end: t_i becomes 1 - t_(n-i). InputError (bad_option) if positions so close to
    /// 0 that 1 - t cannot tell them apart would coincide.
    [[nodiscard]] Spacing reversed() const {
        std::vector<double> t(positions_.size());
        for (std::size_t i = 0; i < t.size(); ++i) {
            t[i] = 1.0 - positions_[t.size() - 1 - i];
        }
        return checked(std::move(t), "the reversed spacing has coinciding positions");
    }

    friend bool operator==(const Spacing&, const Spacing&) = default;

private:
    explicit Spacing(std::vector<double> positions) : positions_(std::move(positions)) {}

    static void require_intervals(std::size_t n) {
        if (n == 0) {
            throw InputError(ErrorCode::bad_option, "a spacing needs at least one interval");
        }
    }

    static Spacing checked(std::vector<double> positions, const char* message) {
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

    std::vector<double> positions_;
};

}  // namespace pavior
