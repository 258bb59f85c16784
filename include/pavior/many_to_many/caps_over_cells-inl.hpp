#pragma once

#include <pavior/many_to_many/caps_over_cells.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<std::pair<Index, int>> boundary_edges(const PlaneArrangement& plane, const ExtrudedCap& cap) {
    std::vector<Index> edges;
    for (const Index c : cap.curves) {
        if (std::count(cap.curves.begin(), cap.curves.end(), c) == 1) {
            for (const OrientedPlaneEdge& use : plane.routes[c]) {
                edges.push_back(use.edge);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<Index, int>> result;
    for (const Index e : edges) {
        if (result.empty() || result.back().first != e) {
            result.emplace_back(e, 0);
        }
        ++result.back().second;
    }
    return result;
}

PAVIOR_INLINE std::vector<Index> cells_inside(const PlaneArrangement& plane,
                                              const std::vector<std::pair<Index, int>>& boundary) {
    const auto crosses = [&](Index edge) {
        const auto at = std::lower_bound(boundary.begin(), boundary.end(), std::pair(edge, 0));
        return at != boundary.end() && at->first == edge && at->second % 2 != 0;
    };
    constexpr char unknown = 2;
    std::vector<char> inside(plane.cells.size(), unknown);
    std::vector<Index> stack;
    const auto reach = [&](Index cell, bool is_inside) {
        if (cell != no_index && inside[cell] == unknown) {
            inside[cell] = static_cast<char>(is_inside);
            stack.push_back(cell);
        }
    };
    for (Index e = 0; e < plane.edges.size(); ++e) {
        const std::array<Index, 2>& cells = plane.edges[e].cells;
        if (cells[0] == no_index || cells[1] == no_index) {
            reach(cells[0], crosses(e));
            reach(cells[1], crosses(e));
        }
    }
    while (!stack.empty()) {
        const Index cell = stack.back();
        stack.pop_back();
        for (const auto& loop : plane.cells[cell].loops) {
            for (const OrientedPlaneEdge& use : loop) {
                reach(plane.edges[use.edge].cells[use.forward ? 1 : 0], (inside[cell] != 0) != crosses(use.edge));
            }
        }
    }
    std::vector<Index> result;
    for (Index c = 0; c < inside.size(); ++c) {
        if (inside[c] == 1) {
            result.push_back(c);
        }
    }
    return result;
}

PAVIOR_INLINE StackResult check_stack(const ExtrudedBody& body, const CapsOverCell& stack) {
    Index below = no_index;
    for (std::size_t i = 0; i < stack.caps.size(); ++i) {
        const ExtrudedCap& cap = body.caps[stack.caps[i]];
        if (cap.below != below) {
            const int other = body.caps[stack.caps[i == 0 ? 0 : i - 1]].tag;
            std::vector<Index> curves = body.caps[stack.caps[i == 0 ? 0 : i - 1]].curves;
            curves.insert(curves.end(), cap.curves.begin(), cap.curves.end());
            return {{},
                    "faces " + std::to_string(other) + " and " + std::to_string(cap.tag) + " cross each other",
                    {other, cap.tag},
                    curves};
        }
        below = cap.above;
    }
    if (below != no_index) {
        const int tag = body.caps[stack.caps.back()].tag;
        return {{},
                "nothing closes the solid above face " + std::to_string(tag),
                {tag},
                body.caps[stack.caps.back()].curves};
    }
    return {};
}

PAVIOR_INLINE StackResult check_cap(const PlaneArrangement& plane, const ExtrudedCap& cap,
                                    const std::vector<std::pair<Index, int>>& boundary,
                                    const std::vector<Index>& cells) {
    bool lost = cells.empty();
    for (const Index c : cap.curves) {
        lost = lost || plane.routes[c].empty();
    }
    lost = lost || std::any_of(boundary.begin(), boundary.end(), [](const auto& use) { return use.second > 1; });
    if (lost) {
        return {{}, "face " + std::to_string(cap.tag) + " is narrower than the tolerance", {cap.tag}, cap.curves};
    }
    return {};
}

}  // namespace detail

}  // namespace pavior
