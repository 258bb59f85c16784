#pragma once
/// \file
/// Runs over patches that share no cell, in parallel where that pays.

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/smooth/detail/patch.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace pavior::detail {

/// Calls body(k, execution) once for each patch k, whose body reads and writes nothing of another patch. Small patches
/// for which concurrent(patch) holds are shared among the threads, one thread each; the others come one after the other
/// from the calling thread, with all threads to themselves.
template <int D, class Concurrent, class Body>
void for_each_patch(const Execution& execution, const std::vector<Patch<D>>& patches, const Concurrent& concurrent,
                    const Body& body) {
    constexpr std::size_t small_patch = 1024;
    std::vector<std::size_t> small;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        if (patches[k].cells.size() < small_patch && concurrent(patches[k])) {
            small.push_back(k);
        } else {
            body(k, execution);
        }
    }
    std::atomic<std::size_t> next{0};
    parallel_for(execution, std::min<std::size_t>(thread_count(execution), small.size()), 1,
                 [&](std::size_t, std::size_t) {
                     for (std::size_t at = next++; at < small.size(); at = next++) {
                         body(small[at], Execution{1, execution.stop});
                     }
                 });
}

}  // namespace pavior::detail
