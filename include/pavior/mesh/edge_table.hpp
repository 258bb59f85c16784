#pragma once
/// \file
/// The edges of a quad mesh, each with its quads: flat arrays, no hashing.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// True if the quad runs from node \p a to node \p b along one of its edges, which it must have; else from b to a.
[[nodiscard]] constexpr bool runs_along(const QuadCorners& corners, Index a, Index b) {
    for (std::size_t k = 0; k < 4; ++k) {
        if (corners[k] == a) {
            return corners[(k + 1) % 4] == b;
        }
    }
    return false;
}

/// All edges of a set of quads. Corners must be in range and different within a quad (verify_quads.hpp).
/// 8 bytes an edge of a quad and 8 a node; O(n), apart from sorting the few edges of each node.
class EdgeTable {
public:
    /// A quad on the edge from the node whose edges these are to the node `high`.
    struct Use {
        Index high = 0;
        Index quad = 0;

        friend constexpr auto operator<=>(const Use&, const Use&) = default;
    };

    /// Quads q in [0, quad_count) with corners corners_of(q), except those with skip[q] != 0 (empty: all).
    template <class CornersOf>
    EdgeTable(std::size_t node_count, std::size_t quad_count, const CornersOf& corners_of,
              std::span<const char> skip = {})
        : ends_(node_count + 1, 0) {
        const auto each_edge = [&](auto&& body) {
            for (std::size_t q = 0; q < quad_count; ++q) {
                if (!skip.empty() && skip[q] != 0) {
                    continue;
                }
                const QuadCorners c = corners_of(static_cast<Index>(q));
                for (std::size_t k = 0; k < 4; ++k) {
                    body(std::min(c[k], c[(k + 1) % 4]), std::max(c[k], c[(k + 1) % 4]), static_cast<Index>(q));
                }
            }
        };
        each_edge([&](Index low, Index, Index) { ++ends_[low + std::size_t{1}]; });
        for (std::size_t i = 1; i < ends_.size(); ++i) {
            ends_[i] += ends_[i - 1];
        }
        uses_.resize(ends_.back());
        // From here ends_[i] runs from the begin of node i's edges to their end, which is the begin of node i + 1.
        each_edge([&](Index low, Index high, Index quad) { uses_[ends_[low]++] = {high, quad}; });
        sort();
    }

    /// The edges of a mesh.
    template <quad_mesh M>
    explicit EdgeTable(const M& mesh, std::span<const char> skip = {})
        : EdgeTable(
              pavior::node_count(mesh), pavior::quad_count(mesh), [&](Index q) { return quad(mesh, q); }, skip) {}

    /// Calls visit(low, high, uses) for every edge low < high, ascending; `uses` is a span of Use, ascending by quad.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::size_t low = 0; low + 1 < ends_.size(); ++low) {
            for (std::size_t i = begin_of(low); i < ends_[low];) {
                std::size_t end = i + 1;
                while (end < ends_[low] && uses_[end].high == uses_[i].high) {
                    ++end;
                }
                visit(static_cast<Index>(low), uses_[i].high, std::span<const Use>(uses_).subspan(i, end - i));
                i = end;
            }
        }
    }

private:
    [[nodiscard]] std::size_t begin_of(std::size_t low) const { return low == 0 ? 0 : ends_[low - 1]; }
    void sort();

    std::vector<std::size_t> ends_;
    std::vector<Use> uses_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/edge_table-inl.hpp>
#endif
