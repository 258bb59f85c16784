#pragma once

#include <pavior/brep/edge_chain.hpp>

#include <cstddef>
#include <span>

namespace pavior {

PAVIOR_INLINE EdgeChain reversed(std::span<const OrientedEdge> chain) {
    EdgeChain result;
    result.reserve(chain.size());
    for (std::size_t i = chain.size(); i-- > 0;) {
        result.push_back({chain[i].edge, !chain[i].forward});
    }
    return result;
}

}  // namespace pavior
