#pragma once
/// \file
/// A way over the edges of linking sides from the source of a sweep to its target: what the number of layers is.

#include <pavior/brep/brep.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pavior {

/// Edges that lead from the source to the target: the layers are the sum of the intervals of those with 1, minus those
/// with -1. Edges along a row are left out.
struct LayerPath {
    std::vector<std::pair<OrientedEdge, int>> edges;  ///< from the source upwards
    std::vector<FaceId> faces;                        ///< of the edges, no two equal ones in a row
};

/// A way of fewest edges from the start of `sweep.source_loops[loop]` to the target loop; of several the one farther to
/// the left in the first sides. O(e log e) for e edges of the sides.
template <brep B>
[[nodiscard]] LayerPath layer_path(const B& b, const SweepTopology& sweep, std::size_t loop) {
    struct Step {
        VertexId from, to;
        OrientedEdge use;
        int rows = 0;
        FaceId face;
    };
    std::vector<Step> steps;
    std::map<VertexId, std::vector<std::size_t>> leaving;
    const auto add = [&](const EdgeChain& chain, int rows, FaceId face) {
        for (const OrientedEdge& use : chain) {
            const VertexId first = first_vertex(b, use);
            const VertexId last = last_vertex(b, use);
            leaving[first].push_back(steps.size());
            steps.push_back({first, last, use, rows, face});
            leaving[last].push_back(steps.size());
            steps.push_back({last, first, use, -rows, face});
        }
    };
    for (const LinkingSide& side : sweep.loops[loop]) {
        add(side.left, 1, side.face);
        add(side.right, 1, side.face);
        add(side.bottom, 0, side.face);
        add(side.top, 0, side.face);
    }
    std::set<VertexId> ends;
    for (const OrientedEdge& use : sweep.target_loops[loop]) {
        ends.insert(first_vertex(b, use));
    }
    const VertexId start = first_vertex(b, sweep.source_loops[loop].front());
    std::map<VertexId, std::size_t> reached{{start, steps.size()}};  // by which step
    std::vector<VertexId> queue{start};
    std::size_t at = 0;
    while (!ends.contains(queue[at])) {
        for (const std::size_t s : leaving[queue[at]]) {
            if (reached.emplace(steps[s].to, s).second) {
                queue.push_back(steps[s].to);
            }
        }
        PAVIOR_ASSERT(at + 1 < queue.size());
        ++at;
    }
    LayerPath way;
    for (VertexId v = queue[at]; v != start; v = steps[reached[v]].from) {
        const Step& step = steps[reached[v]];
        if (step.rows != 0) {
            way.edges.emplace_back(step.use, step.rows);
            if (way.faces.empty() || way.faces.back() != step.face) {
                way.faces.push_back(step.face);
            }
        }
    }
    std::reverse(way.edges.begin(), way.edges.end());
    std::reverse(way.faces.begin(), way.faces.end());
    return way;
}

}  // namespace pavior
