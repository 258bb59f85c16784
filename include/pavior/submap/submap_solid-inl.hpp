#pragma once

#include <pavior/smooth/hexes.hpp>
#include <pavior/submap/submap_check.hpp>
#include <pavior/submap/submap_solid.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<HexCorners> lattice_hexes(const LogicalGrid<3>& grid) {
    std::vector<HexCorners> hexes;
    hexes.reserve(grid.cell_count());
    grid.for_each_cell([&](const LatticePoint<3>& c) {
        const auto at = [&](int i, int j, int k) { return grid.node({c[0] + i, c[1] + j, c[2] + k}); };
        hexes.push_back(
            {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
    });
    return hexes;
}

PAVIOR_INLINE SmoothReport improve_solid(std::vector<Vec3>& points, std::span<const HexCorners> hexes,
                                         std::vector<std::uint8_t> fixed, const SolidSubmapOptions& options) {
    const bool inner = std::find(fixed.begin(), fixed.end(), 0) != fixed.end();
    if (!options.smooth) {
        fixed.assign(fixed.size(), 1);
    }
    UntangleOptions untangle;
    untangle.execution = options.execution;
    SmoothReport result = untangle_hexes(points, hexes, fixed, untangle);
    if (options.smooth && inner && result.min_det_after < options.sufficient_jacobian) {
        untangle.always = true;
        SmoothReport again = untangle_hexes(points, hexes, fixed, untangle);
        again.status =
            result.status == SmoothStatus::repaired && again.inverted_after == 0 ? result.status : again.status;
        again.inverted_before = result.inverted_before;
        again.min_det_before = result.min_det_before;
        again.iterations += result.iterations;
        again.moved_nodes = std::max(again.moved_nodes, result.moved_nodes);
        return again;
    }
    return result;
}

}  // namespace detail

}  // namespace pavior
