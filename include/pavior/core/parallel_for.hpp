#pragma once
/// \file
/// Loops over pieces of a range, one piece a thread.

#include <pavior/core/execution.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace pavior {

/// The number of threads that \p execution allows on this machine, at least 1.
[[nodiscard]] inline unsigned thread_count(Execution execution) {
    return execution.threads != 0 ? execution.threads : std::max(1U, std::thread::hardware_concurrency());
}

/// Calls body(begin, end) on contiguous pieces of [0, count), each piece once, at most one piece a thread.
/// \p body must give the same result however [0, count) is cut: then the outcome is the same bytes for any policy.
/// Pieces start at multiples of \p grain. The exception of the lowest piece is rethrown. O(count) calls' work.
template <class Body>
void parallel_for(Execution execution, std::size_t count, std::size_t grain, Body&& body) {
    const std::size_t grains = (count + grain - 1) / grain;
    const std::size_t pieces = std::min<std::size_t>(thread_count(execution), grains);
    if (pieces <= 1) {
        if (count != 0) {
            body(std::size_t{0}, count);
        }
        return;
    }
    std::vector<std::exception_ptr> errors(pieces);
    const auto run = [&](std::size_t piece) {
        try {
            body(grains * piece / pieces * grain, std::min(count, grains * (piece + 1) / pieces * grain));
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
