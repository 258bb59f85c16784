#pragma once

#include <pavior/core/error.hpp>
#include <pavior/one_to_one/intervals.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void fill_assignment(const IntervalSystem& system, const std::vector<EdgeId>& edges,
                                   std::span<const SweepTopology> sweeps, std::size_t edge_count,
                                   const IntervalResult& solved, IntervalAssignment& result) {
    result.intervals.assign(edge_count, 0);
    result.objective = 0.0;
    result.optimal = solved.status == ProgramStatus::optimal;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        result.intervals[edges[i].index()] = solved.numbers[i];
        const double cost = interval_cost(solved.numbers[i], system.edges[i].wish);
        result.objective += cost;
        if (!result.worst_edge.valid() || 1.0 + cost > result.worst_ratio) {
            result.worst_ratio = 1.0 + cost;
            result.worst_edge = edges[i];
        }
    }
    result.mean_ratio = 1.0 + (edges.empty() ? 0.0 : result.objective / static_cast<double>(edges.size()));
    for (const SweepTopology& sweep : sweeps) {
        int layers = 0;
        for (const std::vector<SidePlacement>& sides : place_sides(sweep, result.intervals)) {
            for (const SidePlacement& side : sides) {
                layers = std::max(layers, side.row + side.rows);
            }
        }
        result.layers.push_back(layers);
    }
}

}  // namespace detail

}  // namespace pavior
