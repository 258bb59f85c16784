#pragma once

#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_closed(std::size_t nodes, const std::vector<QuadCorners>& quads, HexReport& report) {
    const EdgeTable edges(nodes, quads.size(), [&](Index q) { return quads[q]; });
    edges.for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
        if (uses.size() % 2 != 0) {
            report.add(MeshFault::open_boundary, {low, high});
        } else if (uses.size() > 2) {
            ++report.crossed_edges;
        }
    });
}

PAVIOR_INLINE void compare_boundary(std::span<const QuadCorners> given, const std::vector<QuadCorners>& found,
                                    HexReport& report) {
    std::vector<QuadCorners> wanted;
    wanted.reserve(given.size());
    std::transform(given.begin(), given.end(), std::back_inserter(wanted), from_smallest);
    std::vector<QuadCorners> actual = found;
    std::sort(wanted.begin(), wanted.end());
    std::sort(actual.begin(), actual.end());
    std::vector<QuadCorners> differing;
    std::set_difference(wanted.begin(), wanted.end(), actual.begin(), actual.end(), std::back_inserter(differing));
    for (const QuadCorners& c : differing) {
        record(report, MeshFault::boundary_missing, c);
    }
    differing.clear();
    std::set_difference(actual.begin(), actual.end(), wanted.begin(), wanted.end(), std::back_inserter(differing));
    for (const QuadCorners& c : differing) {
        record(report, MeshFault::boundary_extra, c);
    }
}

}  // namespace detail

}  // namespace pavior
