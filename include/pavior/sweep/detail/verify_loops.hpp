#pragma once
/// \file
/// Comparison of given loops with the boundary of a mesh.

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior::detail {

/// What is wrong with the loops; an empty message is a match.
struct LoopMatch {
    std::string message;
    Error::Ids ids;
    bool reversed = false;  ///< all loops run against the mesh
};

[[nodiscard]] inline LoopMatch mismatch(std::string message, Error::Ids ids) {
    return {std::move(message), std::move(ids), false};
}

/// The only fault that loops can have without a mesh: a node twice. Ids: the node.
[[nodiscard]] inline LoopMatch match_loops_alone(const Loops& loops) {
    std::vector<Index> sorted = loops.nodes;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    return twice == sorted.end() ? LoopMatch{}
                                 : mismatch("the loops name node " + std::to_string(*twice) + " twice", {*twice});
}

/// A corner of the first quad that no chain of quads connects to a loop node, if there is one. All ids are in range.
[[nodiscard]] inline std::optional<Index> unreached_node(std::size_t nodes, std::span<const QuadCorners> quads,
                                                         std::span<const Index> loop) {
    DisjointSets sets(nodes);
    for (const QuadCorners& quad : quads) {
        for (std::size_t k = 1; k < 4; ++k) {
            sets.unite(quad[0], quad[k]);
        }
    }
    std::vector<char> reached(nodes, 0);
    for (const Index i : loop) {
        reached[sets.root(i)] = 1;
    }
    for (const QuadCorners& quad : quads) {
        if (reached[sets.root(quad[0])] == 0) {
            return quad[0];
        }
    }
    return std::nullopt;
}

/// For each boundary node its neighbours along the boundary, no_index elsewhere.
struct BoundaryNeighbours {
    std::vector<Index> next;
    std::vector<Index> previous;

    BoundaryNeighbours(const Loops& boundary, std::size_t nodes) : next(nodes, no_index), previous(nodes, no_index) {
        for (std::size_t l = 0; l < boundary.size(); ++l) {
            const auto loop = boundary[l];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                next[loop[i]] = loop[(i + 1) % loop.size()];
                previous[loop[(i + 1) % loop.size()]] = loop[i];
            }
        }
    }
};

/// Follows one loop along the boundary; `reversed` tells its sense.
[[nodiscard]] inline LoopMatch match_loop(std::span<const Index> loop, const BoundaryNeighbours& boundary,
                                          const std::string& name) {
    const bool against =
        boundary.next[loop[0]] != loop[1 % loop.size()] && boundary.previous[loop[0]] == loop[1 % loop.size()];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index from = loop[i];
        const Index to = loop[(i + 1) % loop.size()];
        if ((against ? boundary.previous[from] : boundary.next[from]) != to) {
            return mismatch(name + ": nodes " + std::to_string(from) + " and " + std::to_string(to) +
                                " do not follow each other on the boundary of the mesh",
                            {from, to});
        }
    }
    return {{}, {}, against};
}

/// Nodes of the loops that lie inside, and nodes of the boundary that no loop holds.
[[nodiscard]] inline LoopMatch match_nodes(const Loops& loops, const Loops& boundary,
                                           const BoundaryNeighbours& neighbours) {
    for (const Index i : loops.nodes) {
        if (neighbours.next[i] == no_index) {
            return mismatch("node " + std::to_string(i) + " of the loops is not on the boundary of the mesh", {i});
        }
    }
    std::vector<char> named(neighbours.next.size(), 0);
    for (const Index i : loops.nodes) {
        named[i] = 1;
    }
    for (const Index i : boundary.nodes) {
        if (named[i] == 0) {
            return mismatch("the mesh has " + std::to_string(boundary.size()) + " boundary loops, " +
                                std::to_string(loops.size()) + " are given; none holds node " + std::to_string(i),
                            {i});
        }
    }
    return {};
}

/// Compares \p loops with \p boundary, the loops of the mesh, whatever their order, first nodes and, if it is the same
/// for all, their sense. All ids are below \p nodes. O(nodes + m log m).
[[nodiscard]] inline LoopMatch match_loops(const Loops& loops, const Loops& boundary, std::size_t nodes) {
    if (LoopMatch alone = match_loops_alone(loops); !alone.message.empty()) {
        return alone;
    }
    const BoundaryNeighbours neighbours(boundary, nodes);
    if (LoopMatch all = match_nodes(loops, boundary, neighbours); !all.message.empty()) {
        return all;
    }
    Error::Ids backwards;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::string name = "loop " + std::to_string(l);
        if (loops[l].empty()) {
            return mismatch(name + " is empty", {static_cast<std::int64_t>(l)});
        }
        const LoopMatch match = match_loop(loops[l], neighbours, name);
        if (!match.message.empty()) {
            return match;
        }
        if (match.reversed) {
            backwards.push_back(static_cast<std::int64_t>(l));
        }
    }
    if (!backwards.empty() && backwards.size() != loops.size()) {
        return mismatch("some loops run against the quads, others with them", backwards);
    }
    return {{}, {}, !backwards.empty()};
}

}  // namespace pavior::detail
