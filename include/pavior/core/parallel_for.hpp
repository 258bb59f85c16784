#pragma once
/// \file
/// Loops over pieces of a range, one piece a thread.

#include <pavior/core/execution.hpp>
#include <pavior/core/stop.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace pavior {

/// The number of threads that \p execution allows on this machine, at least 1.
[[nodiscard]] inline unsigned thread_count(const Execution& execution) {
    return execution.threads != 0 ? execution.threads : std::max(1U, std::thread::hardware_concurrency());
}

namespace detail {

/// body(begin, end); in 64 steps if somebody may ask to stop meanwhile.
template <class Body>
void run_piece(const std::stop_token& stop, std::size_t begin, std::size_t end, std::size_t grain, Body& body) {
    std::size_t step = end - begin;
    if (stop.stop_possible()) {
        step = ((end - begin + 63) / 64 + grain - 1) / grain * grain;
    }
    for (std::size_t at = begin; at < end; at += step) {
        check_stop(stop);
        body(at, std::min(end, at + step));
    }
}

}  // namespace detail

/// Calls body(begin, end) on contiguous pieces of [0, count) that cover it once, each thread on its own share of them.
/// \p body must give the same result however [0, count) is cut: then the outcome is the same bytes for any policy.
/// Pieces start at multiples of \p grain. The exception of the lowest share is rethrown; Stopped before and between
/// pieces if that is asked for. O(count) calls' work.
template <class Body>
void parallel_for(const Execution& execution, std::size_t count, std::size_t grain, Body&& body) {
    check_stop(execution.stop);
    const std::size_t grains = (count + grain - 1) / grain;
    const std::size_t pieces = std::min<std::size_t>(thread_count(execution), grains);
    if (pieces <= 1) {
        if (count != 0) {
            detail::run_piece(execution.stop, 0, count, grain, body);
        }
        return;
    }
    std::vector<std::exception_ptr> errors(pieces);
    const auto run = [&](std::size_t piece) {
        try {
            detail::run_piece(execution.stop, grains * piece / pieces * grain,
                              std::min(count, grains * (piece + 1) / pieces * grain), grain, body);
        } catch (...) {
            errors[piece] = std::current_exception();
        }
    };
    {
        std::vector<std::thread> workers;
        workers.reserve(pieces - 1);
        for (std::size_t piece = 1; piece < pieces; ++piece) {
            workers.emplace_back(run, piece);
        }
        run(0);
        for (std::thread& worker : workers) {
            worker.join();
        }
    }
    for (const std::exception_ptr& error : errors) {
        if (error) {
            std::rethrow_exception(error);
        }
    }
}

}  // namespace pavior
