#pragma once

#include <pavior/sweep/linking_side.hpp>

#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE bool sides_reversed(const GridSides<Vec2>& sides) {
    std::vector<Vec2> loop(sides.bottom.begin(), sides.bottom.end());
    loop.insert(loop.end(), sides.right.begin(), sides.right.end());
    loop.insert(loop.end(), sides.top.rbegin(), sides.top.rend());
    loop.insert(loop.end(), sides.left.rbegin(), sides.left.rend());
    return signed_area(loop) < 0.0;
}

}  // namespace detail

PAVIOR_INLINE LinkingSideMesh linking_side(const GridSides<Vec3>& sides, const LinkingSideOptions& options) {
    LinkingSideMesh side;
    side.nodes = transfinite(sides, options.transfinite);
    side.folded = folded_grid_quads(side.nodes);
    return side;
}

}  // namespace pavior
