#pragma once

#include <pavior/brep/joined_faces.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE std::vector<EdgeLoop> turned_loops(std::span<const EdgeLoop> loops) {
    std::vector<EdgeLoop> result;
    for (const EdgeLoop& loop : loops) {
        EdgeLoop turned;
        for (auto use = loop.rbegin(); use != loop.rend(); ++use) {
            turned.push_back({use->edge, !use->forward});
        }
        result.push_back(std::move(turned));
    }
    return result;
}

}  // namespace pavior::detail
