#pragma once
/// \file
/// Seconds between the stages of a computation.

#include <chrono>
#include <utility>

namespace pavior {

/// Wall-clock time, from construction and from one lap to the next. Monotonic.
class Stopwatch {
public:
    /// Seconds since the last call of lap(), at first since construction.
    [[nodiscard]] double lap() { return seconds(std::exchange(lap_, Clock::now())); }

    /// Seconds since construction.
    [[nodiscard]] double total() const { return seconds(start_); }

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] static double seconds(Clock::time_point since) {
        return std::chrono::duration<double>(Clock::now() - since).count();
    }

    Clock::time_point start_ = Clock::now();
    Clock::time_point lap_ = start_;
};

}  // namespace pavior
