#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace pavior::cli {

/// Ends the program when it is told to (SIGINT, SIGTERM, SIGHUP) or its time is over: first by asking the work at hand
/// to stop, and where that does not listen, by ending the process without a trace. One a process, made before any other
/// thread.
class Guard {
public:
    Guard();
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;
    ~Guard();

    /// For every long call.
    [[nodiscard]] std::stop_token stop() const { return stop_.get_token(); }
    /// Time is over so many seconds after the program began; 0: never. \p last_words is called then.
    void set_limit(double seconds, std::function<void()> last_words = {});
    /// Seconds that are left; 0: as many as it takes. At least a hundredth.
    [[nodiscard]] double seconds_left() const;
    /// From here on the result is being written: time is no matter any more.
    void lift_limit() { set_limit(0); }
    /// After Stopped: says why on standard error, and returns the exit code: 3 for time, 128 + the signal.
    int farewell();

private:
    using Clock = std::chrono::steady_clock;

    void watch();
    void wake();
    [[noreturn]] void end();

    sigset_t signals_;
    Clock::time_point begin_ = Clock::now();
    mutable std::mutex mutex_;
    double limit_ = 0;
    std::function<void()> last_words_;
    std::stop_source stop_;
    std::atomic<int> signal_ = 0;
    std::atomic<bool> over_ = false;
    std::thread watcher_;
};

}  // namespace pavior::cli
