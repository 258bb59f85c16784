#pragma once

#include <pavior/contributions/dual_surfaces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::array<double, 3> region_rgb(Index region) {
    const double hue = 6.0 * std::fmod(0.618033988749895 * static_cast<double>(region), 1.0);
    std::array<double, 3> colour{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double distance = std::abs(std::fmod(hue + 6.0 - 2.0 * static_cast<double>(k), 6.0) - 3.0);
        colour[k] = 0.25 + 0.7 * std::clamp(distance - 1.0, 0.0, 1.0);
    }
    return colour;
}

namespace detail {

PAVIOR_INLINE DualPoints::DualPoints(const TetTopology& topology)
    : topology_(topology),
      edges_(topology.node_count()),
      faces_(edges_ + 2 * topology.edges.size()),
      inner_(faces_ + 3 * topology.faces.size()),
      end_(inner_ + 4 * topology.tet_faces.size()) {
    if (end_ >= no_index) {
        throw InputError(ErrorCode::overflow, "2^32 points or more: " + std::to_string(end_));
    }
}

PAVIOR_INLINE Index DualPoints::id(const TetCorners& c, Index t, std::size_t point) const {
    if (point >= 24) {
        return static_cast<Index>(inner_ + 4 * std::size_t{t} + point - 24);
    }
    if (point < 12) {
        const Index e = topology_.tet_edges[t][point / 2];
        const Index near = c[static_cast<std::size_t>(tet_edges[point / 2][point % 2])];
        return static_cast<Index>(edges_ + 2 * std::size_t{e} + (topology_.edges[e][0] == near ? 0 : 1));
    }
    const std::size_t f = (point - 12) / 3;
    const Index face = topology_.tet_faces[t][f];
    const Index near = c[ascending_faces[f][point % 3]];
    const TriCorners& n = topology_.faces[face];
    return static_cast<Index>(faces_ + 3 * std::size_t{face} + (n[0] == near ? 0 : n[1] == near ? 1 : 2));
}

PAVIOR_INLINE void drop_unused(PointCells& cells) {
    std::vector<Index> place(cells.points.size(), no_index);
    for (const Index i : cells.ids) {
        place[i] = 0;
    }
    Index count = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == 0) {
            place[i] = count;
            cells.points[count++] = cells.points[i];
        }
    }
    cells.points.resize(count);
    for (Index& i : cells.ids) {
        i = place[i];
    }
}

}  // namespace detail

}  // namespace pavior
