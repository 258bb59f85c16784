#pragma once
/// \file
/// Nodes that lie in the place of another one.

#include <pavior/core/compiled.hpp>
#include <pavior/math/box.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior {

/// The box round the finite nodes of a mesh; empty if there is none. O(n).
template <vertex_mesh M>
[[nodiscard]] Box<Vec3> bounds(const M& mesh) {
    Box<Vec3> box;
    for (const Index i : IndexRange(node_count(mesh))) {
        const Vec3 x = node(mesh, i);
        if (x.allFinite()) {
            box.add(x);
        }
    }
    return box;
}

namespace detail {

/// A node in a cell of the grid; `ghost`: it lies in a neighbour, within reach of this one.
struct GridEntry {
    std::uint64_t cell = 0;
    Index node = 0;
    bool ghost = false;
};

/// Grid of cells 16 distances wide, shifted by half a cell so that the nodes on the low sides of the box lie mid-cell.
class NodeGrid {
public:
    NodeGrid(const Vec3& low, double distance) : low_(low), cell_(16.0 * distance) {}

    /// Appends the node to its cell and to those that are nearer than the distance.
    void add(const Vec3& x, Index node, std::vector<GridEntry>& entries) const;

private:
    [[nodiscard]] static std::uint64_t hash(std::int64_t i, std::int64_t j, std::int64_t k);

    Vec3 low_;
    double cell_;
};

}  // namespace detail

/// Pairs {node, earlier node} of nodes not farther apart than \p distance >= 0, one for each node that has an earlier
/// one there (the smallest id), ascending by node. Distances below 1e-15 times the diagonal of the mesh count as that.
/// Nodes that are not finite are left out. O(n log n) by sorting cells of a grid, about 35 bytes a node.
template <vertex_mesh M>
[[nodiscard]] std::vector<std::array<Index, 2>> near_nodes(const M& mesh, double distance) {
    const Box<Vec3> box = bounds(mesh);
    const double reach = std::max(distance, 1e-15 * box.diagonal());
    const detail::NodeGrid grid(box.low, reach > 0.0 ? reach : 1.0);
    std::vector<detail::GridEntry> entries;
    entries.reserve(node_count(mesh) + node_count(mesh) / 2);
    for (const Index i : IndexRange(node_count(mesh))) {
        const Vec3 x = node(mesh, i);
        if (x.allFinite()) {
            grid.add(x, i, entries);
        }
    }
    std::sort(entries.begin(), entries.end(), [](const detail::GridEntry& a, const detail::GridEntry& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.node < b.node;
    });
    std::vector<std::array<Index, 2>> pairs;
    for (std::size_t begin = 0, at = 0; at < entries.size(); ++at) {
        begin = entries[at].cell == entries[begin].cell ? begin : at;
        for (std::size_t i = begin; i < at && !entries[at].ghost; ++i) {
            if ((node(mesh, entries[i].node) - node(mesh, entries[at].node)).stableNorm() <= reach) {
                pairs.push_back({entries[at].node, entries[i].node});
                break;
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/near_nodes-inl.hpp>
#endif
