#pragma once
/// \file
/// Which nodes of a boundary are on the surface that its triangles approximate.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Per node 1 where triangles of three directions or more meet. Other nodes lie within a facet or on a straight edge of
/// the surface that the mesh was made of, wherever the mesh happens to have them, and say nothing about the smooth
/// surface behind it. `normal_of(t)` is the unit normal of triangle t. O(n log n).
template <class Triangles, class NormalOf>
[[nodiscard]] std::vector<char> facet_corners(const Triangles& triangles, std::size_t nodes,
                                              const NormalOf& normal_of) {
    std::vector<std::pair<Index, Index>> uses;  // node, triangle
    for (const Index t : IndexRange(triangles.size())) {
        for (const Index i : triangles[t]) {
            uses.emplace_back(i, t);
        }
    }
    std::sort(uses.begin(), uses.end());
    std::vector<char> corner(nodes, 0);
    for (std::size_t i = 0; i < uses.size();) {
        const Index node = uses[i].first;
        std::array<Vec3, 2> seen;
        std::size_t directions = 0;
        for (; i < uses.size() && uses[i].first == node; ++i) {
            const Vec3 n = normal_of(uses[i].second);
            const auto last = seen.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(directions, 2));
            if (std::any_of(seen.begin(), last, [&](const Vec3& other) { return other.dot(n) > 1 - 1e-7; })) {
                continue;
            }
            if (directions < 2) {
                seen[directions] = n;
            }
            ++directions;
        }
        corner[node] = directions > 2 ? 1 : 0;
    }
    return corner;
}

}  // namespace pavior::detail
