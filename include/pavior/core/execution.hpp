#pragma once
/// \file
/// How many threads an algorithm may use. Results never depend on it.

namespace pavior {

/// Execution policy: 1 = sequential (default), N = at most N threads, 0 = one per hardware thread.
struct Execution {
    unsigned threads = 1;
};

/// The sequential policy.
inline constexpr Execution sequential{1};
/// One thread per hardware thread.
inline constexpr Execution parallel{0};

}  // namespace pavior
