#pragma once
/// \file
/// How well shaped a sweep promises to be, and the rule by which one of several sweeps of a solid is chosen.

#include <pavior/brep/face_corners.hpp>
#include <pavior/brep/seamless.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/side_roles.hpp>
#include <pavior/one_to_one/sweep_conditions.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Largest difference of an interior angle from 90 (or 270) over the corners of a side, degrees.
template <brep B>
[[nodiscard]] double corner_deviation(const B& b, const LinkingSide& side) {
    const OrientedFace f{side.face, side.outward};
    const auto outline = outline_of(side);
    double worst = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto& [use, role] = outline[i];
        const auto& [next, next_role] = outline[(i + 1) % outline.size()];
        if (const int turn = quarter_turn(role, next_role); turn != 0) {
            worst = std::max(worst, std::abs(corner_angle(b, f, use, next) - (180.0 - 90.0 * turn)));
        }
    }
    return worst;
}

/// Largest |angle - 90| between \p side and the \p cap along those of \p edges that lie on the loop of the cap.
/// \p along tells whether the loop runs in the sense that is seen from outside.
template <brep B>
[[nodiscard]] double deviation_from_cap(const B& b, OrientedFace cap, const EdgeLoop& loop, bool along,
                                        const LinkingSide& side, const EdgeChain& edges) {
    double worst = 0.0;
    for (const OrientedEdge& use : edges) {
        if (std::find(loop.begin(), loop.end(), use) == loop.end()) {
            continue;
        }
        for (const double at : {0.0, 0.5, 1.0}) {
            const OrientedEdge seen{use.edge, along ? use.forward : !use.forward};
            const double angle = dihedral_angle(b, cap, {side.face, side.outward}, seen, at);
            worst = std::max(worst, std::abs(angle - 90.0));
        }
    }
    return worst;
}

/// The same for both caps; \p side belongs to loop \p i.
template <brep B>
[[nodiscard]] double cap_deviation(const B& b, const SweepTopology& sweep, std::size_t i, const LinkingSide& side) {
    return std::max(
        deviation_from_cap(b, {sweep.source, sweep.source_outward}, sweep.source_loops[i], false, side, side.bottom),
        deviation_from_cap(b, {sweep.target, sweep.target_outward}, sweep.target_loops[i], true, side, side.top));
}

/// Turning of a chain: of its edges, and from edge to edge where they meet, degrees.
template <brep B>
[[nodiscard]] double chain_turning(const B& b, std::span<const OrientedEdge> chain) {
    double sum = 0.0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        sum += edge_turning(b, chain[i].edge);
        if (i > 0 && last_vertex(b, chain[i - 1]) == first_vertex(b, chain[i])) {
            const Vec3 in = use_direction(b, chain[i - 1], 1), out = use_direction(b, chain[i], 0);
            sum += degrees_per_radian * std::atan2(in.cross(out).norm(), in.dot(out));
        }
    }
    return sum;
}

/// Largest angle between the normals of a cap along its boundary and the first of them, degrees.
template <brep B>
[[nodiscard]] double cap_warp(const B& b, OrientedFace cap) {
    double worst = 0.0;
    Vec3 first = Vec3::Zero();
    for (const EdgeLoop& loop : seamless_loops(b.face_loops(cap.face))) {
        for (const OrientedEdge& use : loop) {
            for (const double at : {0.0, 0.5}) {
                const OrientedEdge seen{use.edge, cap.outward ? use.forward : !use.forward};
                const Vec3 normal = outside_normal(b, cap, seen, at);
                first = first.squaredNorm() > 0.0 ? first : normal;
                worst = std::max(worst, std::atan2(first.cross(normal).norm(), first.dot(normal)));
            }
        }
    }
    return degrees_per_radian * worst;
}

/// Lengthens the ways in \p reach (shortest and longest way from the source to a vertex) by the edges of a rib.
template <brep B>
void extend_ways(const B& b, std::span<const OrientedEdge> rib, std::map<VertexId, std::pair<double, double>>& reach) {
    for (const OrientedEdge& use : rib) {
        const auto from = reach.emplace(first_vertex(b, use), std::pair{0.0, 0.0}).first->second;
        const double length = b.edge_length(use.edge);
        auto& to = reach.emplace(last_vertex(b, use), std::pair{from.first + length, 0.0}).first->second;
        to = {std::min(to.first, from.first + length), std::max(to.second, from.second + length)};
    }
}

/// Shortest and longest way from the source to the target along ribs.
template <brep B>
[[nodiscard]] std::pair<double, double> rib_lengths(const B& b, const SweepTopology& sweep) {
    std::pair<double, double> result{HUGE_VAL, 0.0};
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        std::map<VertexId, std::pair<double, double>> reach;
        for (const LinkingSide& side : sweep.loops[i]) {  // each side comes after those below it
            extend_ways<B>(b, side.left, reach);
            extend_ways<B>(b, side.right, reach);
        }
        for (const OrientedEdge& use : sweep.target_loops[i]) {
            if (const auto end = reach.find(first_vertex(b, use)); end != reach.end()) {
                result = {std::min(result.first, end->second.first), std::max(result.second, end->second.second)};
            }
        }
    }
    return result;
}

}  // namespace detail

/// Measures a sweep: see SweepShape. A few evaluations of the model per edge.
template <brep B>
[[nodiscard]] SweepShape sweep_shape(const B& b, const SweepTopology& sweep) {
    SweepShape shape;
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        for (const LinkingSide& side : sweep.loops[i]) {
            shape.corner_deviation = std::max(shape.corner_deviation, detail::corner_deviation(b, side));
            shape.cap_deviation = std::max(shape.cap_deviation, detail::cap_deviation(b, sweep, i, side));
            shape.rib_turn = std::max(
                {shape.rib_turn, detail::chain_turning<B>(b, side.left), detail::chain_turning<B>(b, side.right)});
        }
        shape.cap_edges += sweep.source_loops[i].size() + sweep.target_loops[i].size();
    }
    const auto [shortest, longest] = detail::rib_lengths(b, sweep);
    shape.rib_ratio = shortest > 0.0 ? longest / shortest : HUGE_VAL;
    shape.cap_warp = std::max(detail::cap_warp(b, {sweep.source, sweep.source_outward}),
                              detail::cap_warp(b, {sweep.target, sweep.target_outward}));
    shape.cap_loops = sweep.source_loops.size();
    return shape;
}

/// Linking sides on which every hexahedron at some corner or along a cap would be flat or inverted, however its nodes
/// are placed: an angle differs from 90 degrees by more than \p max_deviation.
template <brep B>
[[nodiscard]] std::vector<SweepObstacle> shape_obstacles(const B& b, const SweepTopology& sweep, double max_deviation) {
    std::vector<SweepObstacle> result;
    const auto add = [&](const LinkingSide& side, double deviation, const std::string& what) {
        if (deviation > max_deviation) {
            const auto degrees = std::to_string(std::lround(deviation));
            result.push_back({SweepCondition::four_logical_sides, side.face, b.tag(2, side.face.index()),
                              what + " differs from 90 degrees by " + degrees});
        }
    };
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        for (const LinkingSide& side : sweep.loops[i]) {
            add(side, detail::corner_deviation(b, side), "the interior angle at a corner of its logical sides");
            add(side, detail::cap_deviation(b, sweep, i, side), "its angle to a cap");
        }
    }
    return result;
}

/// The rule of choice, term by term; the first that differs decides:
/// 1. no side faces above each other; 2. corners of the linking sides, and angles between them and the caps, nearer to
/// 90 degrees (in steps of 15);
/// 3. more loops on the caps; 4. more edges on the caps (the complex shape to the cap, the plain one to the sides);
/// 5. ribs of equal length (ratio in steps of 2^(1/4)); 6. straighter ribs (steps of 15 degrees); 7. flatter caps
/// (steps of 15 degrees); 8. lower face id of the source, then of the target.
[[nodiscard]] PAVIOR_INLINE bool better_sweep(const SweepTopology& a, const SweepTopology& b);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/sweep_shape-inl.hpp>
#endif
