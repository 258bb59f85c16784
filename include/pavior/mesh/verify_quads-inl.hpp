#pragma once

#include <pavior/mesh/verify_quads.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_components(const std::vector<char>& bad, const VerifyQuadsOptions& options, QuadReport& report,
                                    DisjointSets<>& quads) {
    std::vector<std::int64_t> firsts;
    for (const Index q : IndexRange(bad.size())) {
        if (bad[q] == 0 && quads.root(q) == q) {
            firsts.push_back(static_cast<std::int64_t>(q));
        }
    }
    report.components = firsts.size();
    if (firsts.size() > options.max_components) {
        for (const std::int64_t q : firsts) {
            report.add(MeshFault::disconnected, {q});
        }
    }
}

}  // namespace detail

}  // namespace pavior
