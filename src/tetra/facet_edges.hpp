#pragma once
// The edges of facets, however many meet at one. Internal to the tetra component.

#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior::detail {

/// Edge \p edge (0, 1, 2: from node \p edge to the next) of triangle \p facet, seen from its nodes low < high.
struct FacetEdge {
    Index low = 0;
    Index high = 0;
    Index facet = 0;
    int edge = 0;
    bool forward = true;  ///< the facet runs from low to high

    friend auto operator<=>(const FacetEdge&, const FacetEdge&) = default;
};

/// All edges of all facets, ascending, so that those on the same nodes stand together. O(n log n).
[[nodiscard]] inline std::vector<FacetEdge> facet_edges(std::span<const TriCorners> facets) {
    std::vector<FacetEdge> edges;
    edges.reserve(3 * facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Index a = facets[f][static_cast<std::size_t>(k)];
            const Index b = facets[f][static_cast<std::size_t>((k + 1) % 3)];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(f), k, a < b});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Calls visit(span of the FacetEdge of one edge) for each edge, ascending.
template <class Visit>
void for_each_edge(std::span<const FacetEdge> edges, Visit&& visit) {
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) {
            ++end;
        }
        visit(edges.subspan(i, end - i));
        i = end;
    }
}

}  // namespace pavior::detail
