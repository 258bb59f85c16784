#pragma once

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/edge_chain.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<QuadCorners> flipped(std::vector<QuadCorners> quads) {
    for (QuadCorners& quad : quads) {
        std::swap(quad[1], quad[3]);
    }
    return quads;
}

PAVIOR_INLINE PositionOf::PositionOf(std::span<const Index> ids) {
    positions_.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        positions_.emplace(ids[i], static_cast<Index>(i));
    }
}

}  // namespace detail

}  // namespace pavior
