#pragma once
/// \file
/// How well shaped a sweep promises to be, and the rule by which one of several sweeps of a solid is chosen.

#include <pavior/model/face_corners.hpp>
#include <pavior/model/sweep_topology.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Largest |interior angle - 90| over the corners of a side, degrees.
template <brep B>
[[nodiscard]] double corner_deviation(const B& b, const LinkingSide& side) {
    const OrientedFace f{side.face, side.outward};
    const EdgeChain top = reversed(side.top), left = reversed(side.left);
    const EdgeChain* const chains[] = {&side.bottom, &side.right, &top, &left};
    double worst = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double angle = corner_angle(b, f, chains[i]->back(), chains[(i + 1) % 4]->front());
        worst = std::max(worst, std::abs(angle - 90.0));
    }
    return worst;
}

/// Turning of a chain: of its edges, and from edge to edge, degrees.
template <brep B>
[[nodiscard]] double chain_turning(const B& b, std::span<const OrientedEdge> chain) {
    double sum = 0.0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        sum += edge_turning(b, chain[i].edge);
        if (i > 0) {
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
    for (const EdgeLoop& loop : b.face_loops(cap.face)) {
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
void extend_ways(const B& b, std::span<const OrientedEdge> rib,
                 std::map<VertexId, std::pair<double, double>>& reach) {
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
    for (const std::vector<LinkingSide>& sides : sweep.loops) {
        for (const LinkingSide& side : sides) {
            shape.corner_deviation = std::max(shape.corner_deviation, detail::corner_deviation(b, side));
            shape.rib_turn = std::max({shape.rib_turn, detail::chain_turning<B>(b, side.left),
                                       detail::chain_turning<B>(b, side.right)});
        }
    }
    const auto [shortest, longest] = detail::rib_lengths(b, sweep);
    shape.rib_ratio = shortest > 0.0 ? longest / shortest : HUGE_VAL;
    shape.cap_warp = std::max(detail::cap_warp(b, {sweep.source, sweep.source_outward}),
                              detail::cap_warp(b, {sweep.target, sweep.target_outward}));
    shape.cap_loops = sweep.source_loops.size();
    for (std::size_t i = 0; i < sweep.source_loops.size(); ++i) {
        shape.cap_edges += sweep.source_loops[i].size() + sweep.target_loops[i].size();
    }
    return shape;
}

/// The rule of choice, term by term; the first that differs decides:
/// 1. no side faces above each other; 2. corners of the linking sides nearer to 90 degrees (in steps of 15);
/// 3. more loops on the caps; 4. more edges on the caps (the complex shape to the cap, the plain one to the sides);
/// 5. ribs of equal length (ratio in steps of 2^(1/4)); 6. straighter ribs (steps of 15 degrees); 7. flatter caps
/// (steps of 15 degrees); 8. lower face id of the source, then of the target.
[[nodiscard]] inline bool better_sweep(const SweepTopology& a, const SweepTopology& b) {
    const auto rank = [](const SweepTopology& s) {
        const auto steps = [](double value, double step) { return std::floor(value / step + 1e-6); };
        return std::tuple(s.stacked, steps(s.shape.corner_deviation, 15.0),
                          -static_cast<double>(s.shape.cap_loops), -static_cast<double>(s.shape.cap_edges),
                          steps(std::log2(std::min(s.shape.rib_ratio, 1e9)), 0.25), steps(s.shape.rib_turn, 15.0),
                          steps(s.shape.cap_warp, 15.0), s.source, s.target);
    };
    return rank(a) < rank(b);
}

}  // namespace pavior
