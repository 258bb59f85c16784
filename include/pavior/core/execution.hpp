#pragma once
/// \file
/// How many threads an algorithm may use, and who may stop it. Results never depend on it.

#include <stop_token>

namespace pavior {

/// Execution policy.
struct Execution {
    unsigned threads = 1;  ///< 1: sequential (default), N: at most N threads, 0: one per hardware thread
    /// When it asks to stop, the call throws Stopped (core/stop.hpp) within 50 ms as a rule: so that
    /// `options.execution = {threads, source.get_token()}` lets another thread, or the sink of Progress, end a call by
    /// source.request_stop(). Default: nobody asks.
    std::stop_token stop = {};
};

/// The sequential policy.
inline const Execution sequential{1};
/// One thread per hardware thread.
inline const Execution parallel{0};

}  // namespace pavior
