#pragma once
// Clocks of the benchmarks.

#include <chrono>
#include <ctime>

/// Wall clock: for several threads.
template <class Work>
double seconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Processor time of this thread: what one-thread ratios compare, so that other programs disturb them less.
template <class Work>
double thread_seconds(const Work& work) {
#if defined(CLOCK_THREAD_CPUTIME_ID)
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
#else
    return seconds(work);
#endif
}
