#include "guard.hpp"

#include "exit_code.hpp"

#include <pavior/io/atomic_file.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <iostream>
#include <optional>
#include <utility>

#include <unistd.h>

namespace pavior::cli {

namespace {

constexpr int wake_up = SIGUSR1;
constexpr double patience = 1.0;  // seconds from asking to ending

timespec to_timespec(double seconds) {
    const double whole = std::floor(seconds);
    return {static_cast<time_t>(whole), static_cast<long>(1e9 * (seconds - whole))};
}

}  // namespace

Guard::Guard() {
    std::signal(SIGXFSZ, SIG_IGN);  // the writer is told, and says so
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, wake_up}) {
        sigaddset(&signals_, signal);
    }
    sigprocmask(SIG_BLOCK, &signals_, nullptr);
    watcher_ = std::thread([this] { watch(); });
}

Guard::~Guard() {
    over_ = true;
    wake();
    watcher_.join();
}

void Guard::set_limit(double seconds, std::function<void()> last_words) {
    {
        const std::scoped_lock lock(mutex_);
        limit_ = seconds;
        last_words_ = std::move(last_words);
    }
    wake();
}

double Guard::seconds_left() const {
    const std::scoped_lock lock(mutex_);
    const std::chrono::duration<double> gone = Clock::now() - begin_;
    return limit_ > 0 ? std::max(limit_ - gone.count(), 0.01) : 0.0;
}

int Guard::farewell() {
    if (signal_ != 0) {
        std::cerr << "pavior: ended by signal " << signal_ << "; nothing was written\n";
        return 128 + signal_;
    }
    std::function<void()> last_words;
    {
        const std::scoped_lock lock(mutex_);
        std::cerr << "pavior: not meshable within the time limit of " << limit_ << " s; nothing was written\n";
        last_words = std::exchange(last_words_, nullptr);
    }
    if (last_words) {
        try {
            last_words();
        } catch (const std::exception& error) {
            std::cerr << "pavior: " << error.what() << "\n";
        }
    }
    return exit_not_meshable;
}

void Guard::wake() { ::kill(::getpid(), wake_up); }

void Guard::watch() {
    std::optional<Clock::time_point> asked;
    while (!over_) {
        double wait = 3600;
        if (asked) {
            wait = patience - std::chrono::duration<double>(Clock::now() - *asked).count();
        } else if (const double left = seconds_left(); left > 0) {
            wait = left;
        }
        const timespec time = to_timespec(std::clamp(wait, 0.0, 3600.0));
        const int got = sigtimedwait(&signals_, nullptr, &time);
        if (over_ || got == wake_up) {
            continue;
        }
        const bool time_over = got < 0 && !asked && seconds_left() == 0.01;
        if (got > 0 || time_over) {
            if (asked) {
                end();  // told twice
            }
            signal_ = std::max(got, 0);
            asked = Clock::now();
            stop_.request_stop();
        } else if (got < 0 && asked && Clock::now() - *asked >= std::chrono::duration<double>(patience)) {
            end();
        }
    }
}

void Guard::end() {
    const int code = farewell();
    discard_unfinished_files();
    _exit(code);
}

}  // namespace pavior::cli
