#pragma once
/// \file
/// Reductions that give the same bytes for any number of threads.

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace pavior {

/// Results of body(begin, end) for the pieces [0, grain), [grain, 2 grain) ... of [0, count), in this order. The pieces
/// do not depend on the policy: fold the results from first to last and the outcome does not either.
/// Exceptions as in parallel_for().
template <class Body>
[[nodiscard]] auto map_chunks(Execution execution, std::size_t count, std::size_t grain, const Body& body) {
    using Result = std::decay_t<decltype(body(std::size_t{}, std::size_t{}))>;
    std::vector<Result> results((count + grain - 1) / grain);
    parallel_for(execution, results.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t chunk = first; chunk < last; ++chunk) {
            Result result = body(chunk * grain, std::min(count, (chunk + 1) * grain));
            results[chunk] = std::move(result);
        }
    });
    return results;
}

}  // namespace pavior
