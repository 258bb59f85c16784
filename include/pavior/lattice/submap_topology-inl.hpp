#pragma once

#include <pavior/core/error.hpp>
#include <pavior/lattice/submap_topology.hpp>

#include <set>
#include <string>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::string list(const std::set<int>& tags, const std::string& one, const std::string& many) {
    std::string text = tags.size() == 1 ? one : many;
    for (const int tag : tags) {
        text += (tag == *tags.begin() ? " " : ", ") + std::to_string(tag);
    }
    return text;
}

}  // namespace detail

}  // namespace pavior
