#pragma once

#include <pavior/brep/solid_boundary.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<std::size_t> SolidBoundary::loop_from(std::size_t first) const {
    std::vector<std::size_t> result;
    std::size_t h = first;
    do {
        result.push_back(h);
        h = half_edges[h].next;
    } while (h != first);
    return result;
}

}  // namespace pavior
