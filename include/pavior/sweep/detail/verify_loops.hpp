#pragma once
/// \file
/// Comparison of given loops with the boundary of a mesh.

#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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

/// Compares \p loops with \p boundary, the loops of the mesh, whatever their order, first nodes and, if it is the same
/// for all, their sense. All ids are below \p nodes. O(nodes + m).
[[nodiscard]] inline LoopMatch match_loops(const Loops& loops, const Loops& boundary, std::size_t nodes) {
    if (LoopMatch alone = match_loops_alone(loops); !alone.message.empty()) {
        return alone;
    }
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> next(nodes, none);
    std::vector<Index> previous(nodes, none);
    for (std::size_t l = 0; l < boundary.size(); ++l) {
        const auto loop = boundary[l];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            next[loop[i]] = loop[(i + 1) % loop.size()];
            previous[loop[(i + 1) % loop.size()]] = loop[i];
        }
    }
    std::size_t reversed = 0;
    Error::Ids backwards;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const auto loop = loops[l];
        const std::string name = "loop " + std::to_string(l);
        if (loop.empty()) {
            return mismatch(name + " is empty", {static_cast<std::int64_t>(l)});
        }
        const bool against = loop.size() > 1 && previous[loop[0]] == loop[1] && next[loop[0]] != loop[1];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index from = loop[i];
            const Index to = loop[(i + 1) % loop.size()];
            if (next[from] == none) {
                return mismatch(name + ": node " + std::to_string(from) + " is not on the boundary of the mesh", {from});
            }
            if ((against ? previous[from] : next[from]) != to) {
                return mismatch(name + ": nodes " + std::to_string(from) + " and " + std::to_string(to) +
                                    " do not follow each other on the boundary of the mesh", {from, to});
            }
        }
        reversed += against ? 1 : 0;
        if (against) {
            backwards.push_back(static_cast<std::int64_t>(l));
        }
    }
    if (loops.nodes.size() != boundary.nodes.size()) {
        std::vector<char> named(nodes, 0);
        for (const Index i : loops.nodes) {
            named[i] = 1;
        }
        for (const Index i : boundary.nodes) {
            if (named[i] == 0) {
                return mismatch("the mesh has " + std::to_string(boundary.size()) + " boundary loops, " +
                                    std::to_string(loops.size()) + " are given; none holds node " + std::to_string(i), {i});
            }
        }
    }
    if (reversed != 0 && reversed != loops.size()) {
        return mismatch("some loops run against the quads, others with them", backwards);
    }
    return {{}, {}, reversed != 0};
}

}  // namespace pavior::detail
