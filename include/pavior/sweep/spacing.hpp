#pragma once
/// \file
/// Positions of the levels of a sweep, or of the nodes of an edge, in [0, 1].

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>

#include <cstddef>
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
    [[nodiscard]] static Spacing uniform(std::size_t n);

    /// Each interval is \p ratio times as long as the one before; ratio 1 gives uniform(n).
    /// InputError (bad_option) if n = 0, if the ratio is not positive and finite, or if it is so far from 1 that two
    /// positions coincide in double precision.
    [[nodiscard]] static Spacing geometric(std::size_t n, double ratio);

    /// The caller's positions. InputError (bad_option, with the ids of the positions) unless they start at 0, end at 1
    /// and increase strictly.
    [[nodiscard]] static Spacing given(std::vector<double> positions);

    [[nodiscard]] std::size_t intervals() const { return positions_.size() - 1; }
    [[nodiscard]] std::span<const double> positions() const { return positions_; }
    [[nodiscard]] double operator[](std::size_t i) const { return positions_[i]; }

    /// The same intervals from the other end: t_i becomes 1 - t_(n-i). InputError (bad_option) if positions so close to
    /// 0 that 1 - t cannot tell them apart would coincide.
    [[nodiscard]] Spacing reversed() const;

    friend bool operator==(const Spacing&, const Spacing&) = default;

private:
    explicit Spacing(std::vector<double> positions) : positions_(std::move(positions)) {}

    static void require_intervals(std::size_t n) {
        if (n == 0) {
            throw InputError(ErrorCode::bad_option, "a spacing needs at least one interval");
        }
    }

    static Spacing checked(std::vector<double> positions, const char* message);

    std::vector<double> positions_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/spacing-inl.hpp>
#endif
