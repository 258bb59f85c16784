#pragma once
/// \file
/// The input of a one-to-one sweep: two caps of one connectivity and the loops of all levels between them.

#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/sweep/level_points.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// A sweep with n nodes a level, m of them on the boundary loops, and r layers (chapter 4 of \cite roca2009).
/// Quads run counter-clockwise seen from the tip of the sweep direction (source to target), outer loops
/// counter-clockwise, holes clockwise. Which loop comes first and where a loop starts do not matter.
struct SweepProblem {
    std::vector<Vec3> source_nodes;     ///< n points, level 0
    std::vector<Vec3> target_nodes;     ///< n points, level r, in the order of the source nodes
    std::vector<QuadCorners> quads;     ///< quads of both caps
    Loops loops;                        ///< the boundary of the quads, m node ids in all
    std::vector<Vec3> boundary_levels;  ///< (r + 1) x m points, level by level, in the order of loops.nodes
    std::size_t layers = 0;             ///< r, the number of layers of hexahedra

    /// The m loop points of level k, 0 <= k <= r.
    [[nodiscard]] std::span<const Vec3> level(std::size_t k) const {
        return std::span(boundary_levels).subspan(k * loops.nodes.size(), loops.nodes.size());
    }
    [[nodiscard]] std::size_t level_size() const { return source_nodes.size(); }
};

namespace detail {

template <level_points L>
void copy_levels(const L& levels, SweepProblem& problem) {
    using access = level_access<L>;
    const std::size_t m = problem.loops.nodes.size();
    const std::size_t count = static_cast<std::size_t>(access::level_count(levels));
    problem.layers = count == 0 ? 0 : count - 1;
    problem.boundary_levels.reserve(count * m);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t points = static_cast<std::size_t>(access::point_count(levels, k));
        if (points != m) {
            throw InputError(ErrorCode::size_mismatch,
                             "level " + std::to_string(k) + " has " + std::to_string(points) +
                                 " points, the loops have " + std::to_string(m) + " nodes",
                             {static_cast<std::int64_t>(k)});
        }
        for (std::size_t i = 0; i < m; ++i) {
            problem.boundary_levels.push_back(to_vec3(access::point(levels, k, i)));
        }
    }
}

template <vertex_mesh M>
std::vector<Vec3> copy_nodes(const M& mesh) {
    std::vector<Vec3> nodes;
    nodes.reserve(node_count(mesh));
    for (const Index i : IndexRange(node_count(mesh))) {
        nodes.push_back(node(mesh, i));
    }
    return nodes;
}

}  // namespace detail

/// Copies any source mesh, target nodes, loops and levels into flat arrays. Nothing is checked but the sizes of the
/// levels: a level that has not one point for each loop node throws InputError(size_mismatch) with its number; all
/// else is left to verify_problem(). O(n + quads + m r) time and memory.
template <quad_mesh Source, vertex_mesh Target, level_points Levels>
[[nodiscard]] SweepProblem make_sweep_problem(const Source& source, const Target& target, const Loops& loops,
                                              const Levels& levels) {
    SweepProblem problem;
    problem.source_nodes = detail::copy_nodes(source);
    problem.target_nodes = detail::copy_nodes(target);
    problem.quads.reserve(quad_count(source));
    for (const Index q : IndexRange(quad_count(source))) {
        problem.quads.push_back(quad(source, q));
    }
    problem.loops = loops;
    detail::copy_levels(levels, problem);
    return problem;
}

/// The same with the loops that boundary_loops(source) finds; the levels must list their points in that order.
template <quad_mesh Source, vertex_mesh Target, level_points Levels>
[[nodiscard]] SweepProblem make_sweep_problem(const Source& source, const Target& target, const Levels& levels) {
    return make_sweep_problem(source, target, boundary_loops(source), levels);
}

}  // namespace pavior
