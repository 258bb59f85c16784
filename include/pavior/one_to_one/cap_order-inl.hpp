#pragma once

#include <pavior/one_to_one/cap_order.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE SweepTopology reversed(const SweepTopology& sweep) {
    SweepTopology result = sweep;
    std::swap(result.source, result.target);
    std::swap(result.source_outward, result.target_outward);
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        result.source_loops[i] = reversed(sweep.target_loops[i]);
        result.target_loops[i] = reversed(sweep.source_loops[i]);
        std::vector<LinkingSide>& sides = result.loops[i];
        std::reverse(sides.begin(), sides.end());
        for (LinkingSide& side : sides) {
            side = upside_down(side);
        }
    }
    return result;
}

namespace detail {

PAVIOR_INLINE CapWalk::CapWalk(std::span<const SweepTopology> sweeps) : sweeps_(sweeps), done_(sweeps.size(), false) {
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        users_[sweeps[i].source].push_back(i);
        users_[sweeps[i].target].push_back(i);
    }
}

PAVIOR_INLINE void CapWalk::run(FaceId cap) {
    for (std::size_t i = next(cap); i < sweeps_.size(); i = next(cap)) {
        const bool backwards = sweeps_[i].source != cap;
        order_.push_back({i, backwards});
        done_[i] = true;
        cap = backwards ? sweeps_[i].source : sweeps_[i].target;
    }
}

PAVIOR_INLINE FaceId CapWalk::far_end(std::size_t i) const {
    std::vector<bool> seen = done_;
    FaceId cap = sweeps_[i].source;
    seen[i] = true;
    for (std::size_t j = next(cap, seen); j < sweeps_.size(); j = next(cap, seen)) {
        seen[j] = true;
        cap = sweeps_[j].source == cap ? sweeps_[j].target : sweeps_[j].source;
    }
    return cap == sweeps_[i].target ? sweeps_[i].source : cap;  // a closed chain comes back from the other side
}

PAVIOR_INLINE std::size_t CapWalk::next(FaceId cap, const std::vector<bool>& taken) const {
    for (const std::size_t i : users_.at(cap)) {
        if (!taken[i]) {
            return i;
        }
    }
    return sweeps_.size();
}

}  // namespace detail

}  // namespace pavior
