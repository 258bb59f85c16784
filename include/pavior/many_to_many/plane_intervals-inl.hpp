#pragma once

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/plane_intervals.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE PolylineSize polyline_size(std::span<const Vec2> points) {
    PolylineSize size;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec2 along = points[i + 1] - points[i];
        size.length += along.norm();
        if (i > 0) {
            const Vec2 before = points[i] - points[i - 1];
            size.turning += std::abs(std::atan2(before[0] * along[1] - before[1] * along[0], before.dot(along)));
        }
    }
    return size;
}

/// The unit tangent at the start of an edge as it is used, averaged over about \p reach.
[[nodiscard]] inline Vec2 start_tangent(const PlaneEdge& edge, bool forward, double reach) {
    const std::size_t n = edge.points.size();
    const Vec2& from = forward ? edge.points.front() : edge.points.back();
    for (std::size_t i = 1; i < n; ++i) {
        const Vec2 along = (forward ? edge.points[i] : edge.points[n - 1 - i]) - from;
        if (along.norm() >= reach || i + 1 == n) {
            return along.normalized();
        }
    }
    return Vec2::Zero();
}

/// Positions in a loop of a cell where the boundary turns left by more than 45 degrees: corners of the cell. Nothing if
/// it turns right by as much somewhere.
[[nodiscard]] inline std::optional<std::vector<std::size_t>> convex_corners(const PlaneArrangement& plane,
                                                                            std::span<const OrientedPlaneEdge> loop) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const OrientedPlaneEdge& before = loop[(i + loop.size() - 1) % loop.size()];
        const Vec2 in = -start_tangent(plane.edges[before.edge], !before.forward, 0);
        const Vec2 out = start_tangent(plane.edges[loop[i].edge], loop[i].forward, 0);
        const double turn = std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
        if (turn > std::numbers::pi / 4) {
            corners.push_back(i);
        } else if (turn < -std::numbers::pi / 4) {
            return std::nullopt;
        }
    }
    return corners;
}

/// Fewest intervals of the only loop of a cell: 6 for three corners, 8 for fewer, so that quads fit in.
[[nodiscard]] inline int least_intervals(const PlaneArrangement& plane, std::span<const OrientedPlaneEdge> loop) {
    const auto corners = convex_corners(plane, loop);
    return !corners || corners->size() > 3 ? 4 : corners->size() == 3 ? 6 : 8;
}

/// The four sides of a cell as positions in its loop, if it is logically four-sided.
[[nodiscard]] inline std::optional<std::array<std::vector<std::size_t>, 4>> four_sides(const PlaneArrangement& plane,
                                                                                       const PlaneCell& cell) {
    if (cell.loops.size() != 1) {
        return std::nullopt;
    }
    const auto& loop = cell.loops[0];
    const auto corners = convex_corners(plane, loop);
    if (!corners || corners->size() != 4) {
        return std::nullopt;
    }
    std::array<std::vector<std::size_t>, 4> sides;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = (*corners)[k]; i != (*corners)[(k + 1) % 4]; i = (i + 1) % loop.size()) {
            sides[k].push_back(i);
        }
    }
    return sides;
}

/// A cell that is one quad of a given mesh.
[[nodiscard]] inline bool is_given_quad(const PlaneCell& cell, std::span<const char> given) {
    return !given.empty() && cell.loops.size() == 1 && cell.loops[0].size() == 4 &&
           std::all_of(cell.loops[0].begin(), cell.loops[0].end(), [&](auto& use) { return given[use.edge] != 0; });
}

PAVIOR_INLINE IntervalSystem plane_interval_system(const PlaneArrangement& plane, std::span<const char> wanted,
                                                   std::span<const double> edge_sizes, double max_angle,
                                                   std::span<const char> given) {
    IntervalSystem system;
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        if (!given.empty() && given[e] != 0) {
            system.edges.push_back({1.0, 1});
            system.rules.push_back({IntervalRule::Kind::equal, {{e, 1}}, 1, "a given mesh is kept", {}});
            continue;
        }
        const PolylineSize size = polyline_size(plane.edges[e].points);
        const int lower = std::max(1, static_cast<int>(std::ceil(size.turning / max_angle - 0.01)));
        system.edges.push_back({std::max(size.length / edge_sizes[e], static_cast<double>(lower)), lower});
    }
    for (std::size_t c = 0; c < plane.cells.size(); ++c) {
        if (wanted[c] == 0 || is_given_quad(plane.cells[c], given)) {
            continue;
        }
        for (const auto& loop : plane.cells[c].loops) {
            std::vector<std::pair<std::size_t, int>> terms;
            for (const OrientedPlaneEdge& use : loop) {
                const auto at = std::find_if(terms.begin(), terms.end(), [&](auto& t) { return t.first == use.edge; });
                if (at == terms.end()) {
                    terms.emplace_back(use.edge, 1);
                } else {
                    ++at->second;
                }
            }
            const std::string text = "a loop of cell " + std::to_string(c) + " has ";
            const int least = plane.cells[c].loops.size() == 1 ? least_intervals(plane, loop) : 4;
            system.rules.push_back({IntervalRule::Kind::even, terms, 0, text + "evenly many intervals", {}});
            system.rules.push_back(
                {IntervalRule::Kind::at_least, terms, least, text + std::to_string(least) + " intervals", {}});
        }
    }
    return system;
}

PAVIOR_INLINE std::vector<IntervalRule> mapping_rules(const PlaneArrangement& plane, std::span<const char> wanted) {
    std::vector<IntervalRule> rules;
    for (std::size_t c = 0; c < plane.cells.size(); ++c) {
        const auto sides = wanted[c] != 0 ? four_sides(plane, plane.cells[c]) : std::nullopt;
        for (std::size_t k = 0; sides && k < 2; ++k) {
            IntervalRule rule;
            rule.text = "opposite sides of cell " + std::to_string(c) + " are equal";
            for (const std::size_t i : (*sides)[k]) {
                rule.terms.emplace_back(plane.cells[c].loops[0][i].edge, 1);
            }
            for (const std::size_t i : (*sides)[k + 2]) {
                rule.terms.emplace_back(plane.cells[c].loops[0][i].edge, -1);
            }
            rules.push_back(std::move(rule));
        }
    }
    return rules;
}

PAVIOR_INLINE std::vector<IntervalRule> free_mapping_rules(const PlaneArrangement& plane, std::span<const char> wanted,
                                                           std::span<const char> given) {
    const std::vector<IntervalRule> rules = mapping_rules(plane, wanted);
    const auto touches = [&](const IntervalRule& rule) {
        return std::any_of(rule.terms.begin(), rule.terms.end(),
                           [&](const auto& term) { return given[term.first] != 0; });
    };
    std::vector<IntervalRule> result;
    for (std::size_t i = 0; i + 1 < rules.size(); i += 2) {  // two a cell
        if (!touches(rules[i]) && !touches(rules[i + 1])) {
            result.insert(result.end(), {rules[i], rules[i + 1]});
        }
    }
    return result;
}

PAVIOR_INLINE double worst_interval_ratio(const IntervalSystem& system, const std::vector<int>& numbers) {
    double worst = 1;
    for (std::size_t e = 0; e < numbers.size(); ++e) {
        worst = std::max(worst, 1 + interval_cost(numbers[e], system.edges[e].wish));
    }
    return worst;
}

}  // namespace detail

}  // namespace pavior
