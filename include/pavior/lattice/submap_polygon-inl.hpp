#pragma once

#include <pavior/core/error.hpp>
#include <pavior/lattice/grid_laplace.hpp>
#include <pavior/lattice/submap_polygon.hpp>
#include <pavior/smooth/quads.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Interior angles of a loop with the inside on its left, degrees in [0, 360).
[[nodiscard]] inline std::vector<double> interior_angles(std::span<const Vec2> loop) {
    std::vector<double> result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 out = loop[(i + 1) % loop.size()] - loop[i];
        const Vec2 back = loop[(i + loop.size() - 1) % loop.size()] - loop[i];
        const double angle = std::atan2(out.x() * back.y() - out.y() * back.x(), out.dot(back));
        result.push_back((angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle) * 180.0 / std::numbers::pi);
    }
    return result;
}

/// A loop of a polygon on the lattice.
struct LatticeLoop {
    std::vector<LatticePoint<2>> points;
    std::vector<int> heading;  ///< per segment: 0 +s, 1 +t, 2 -s, 3 -t
};

[[nodiscard]] inline LatticeLoop trace_polygon(const std::vector<CornerClass>& classes, int first, std::size_t number) {
    LatticeLoop result;
    LatticePoint<2> at{0, 0};
    int heading = first;
    std::array<int, 4> steps{};
    for (std::size_t i = 0; i < classes.size(); ++i) {
        heading = i == 0 ? first : (heading + quarter_turns(classes[i]) + 4) % 4;
        result.points.push_back(at);
        result.heading.push_back(heading);
        at[static_cast<std::size_t>(heading % 2)] += heading < 2 ? 1 : -1;
        ++steps[static_cast<std::size_t>(heading)];
    }
    if (at != LatticePoint<2>{0, 0}) {
        throw UnmeshableError(ErrorCode::infeasible_intervals,
                              "loop " + std::to_string(number) + " has " + std::to_string(steps[0]) +
                                  " segments along its first direction and " + std::to_string(steps[2]) +
                                  " against it, " + std::to_string(steps[1]) + " along its second and " +
                                  std::to_string(steps[3]) + " against it; they must be equal",
                              {static_cast<std::int64_t>(number)});
    }
    return result;
}

/// Direction of +s as the segments of a loop see it.
[[nodiscard]] inline std::complex<double> polygon_s(std::span<const Vec2> loop, const LatticeLoop& lattice) {
    static constexpr std::array<std::complex<double>, 4> back{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 d = loop[(i + 1) % loop.size()] - loop[i];
        sum += std::complex<double>(d.x(), d.y()) * back[static_cast<std::size_t>(lattice.heading[i])];
    }
    return sum;
}

inline void add_facets(const LatticeLoop& loop, Index number, std::vector<LatticeFacet<2>>& facets) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        LatticePoint<2> low = loop.points[i];
        const int heading = loop.heading[i];
        low[static_cast<std::size_t>(heading % 2)] -= heading < 2 ? 0 : 1;
        facets.push_back({low, 1 - heading % 2, heading == 1 || heading == 2 ? 1 : -1, number});
    }
}

/// Where point \p q of the plane lies on the lattice, judged by the points placed so far; those near count most.
[[nodiscard]] inline Vec2 estimate_lattice(const Vec2& q, const std::complex<double>& s, const Vec2& spacing,
                                           std::span<const std::vector<Vec2>> loops,
                                           const std::vector<LatticeLoop>& placed) {
    Vec2 sum = Vec2::Zero();
    double weights = 0.0;
    for (std::size_t l = 0; l < placed.size(); ++l) {
        for (std::size_t i = 0; i < placed[l].points.size(); ++i) {
            const Vec2 way = q - loops[l][i];
            const std::complex<double> local = std::complex<double>(way.x(), way.y()) * std::conj(s) / std::abs(s);
            const double weight = 1.0 / std::max(way.squaredNorm(), 1e-300);
            sum += weight * Vec2(placed[l].points[i][0] + local.real() / spacing[0],
                                 placed[l].points[i][1] + local.imag() / spacing[1]);
            weights += weight;
        }
    }
    return sum / weights;
}

/// Moves \p loop to the free place nearest to \p wish for its first point. False if there is none.
[[nodiscard]] inline bool place_hole(LatticeLoop& loop, const Vec2& wish, int max_shift,
                                     const std::vector<LatticeFacet<2>>& others, std::set<LatticePoint<2>>& taken,
                                     Index number) {
    std::vector<std::pair<double, LatticePoint<2>>> places;
    for (int i = -max_shift; i <= max_shift; ++i) {
        for (int j = -max_shift; j <= max_shift; ++j) {
            const LatticePoint<2> at{static_cast<int>(std::lround(wish[0])) + i,
                                     static_cast<int>(std::lround(wish[1])) + j};
            places.emplace_back((Vec2(at[0], at[1]) - wish).squaredNorm(), at);
        }
    }
    std::sort(places.begin(), places.end());
    for (const auto& [distance, at] : places) {
        LatticeLoop moved = loop;
        bool free = true;
        for (LatticePoint<2>& p : moved.points) {
            p = {p[0] + at[0], p[1] + at[1]};
            free = free && !taken.contains(p);
        }
        std::vector<LatticeFacet<2>> facets = others;
        add_facets(moved, number, facets);
        if (free && LogicalGrid<2>(facets).ok()) {
            loop = std::move(moved);
            taken.insert(loop.points.begin(), loop.points.end());
            return true;
        }
    }
    return false;
}

/// All loops on one lattice.
[[nodiscard]] inline std::vector<LatticeLoop> place_loops(std::span<const std::vector<Vec2>> loops,
                                                          std::span<const std::vector<CornerClass>> classes,
                                                          const SubmapPolygonOptions& options) {
    std::vector<LatticeLoop> placed{trace_polygon(classes[0], 0, 0)};
    const std::complex<double> s = polygon_s(loops[0], placed[0]);
    Vec2 length = Vec2::Zero(), count = Vec2::Zero();
    for (std::size_t i = 0; i < loops[0].size(); ++i) {
        const int axis = placed[0].heading[i] % 2;
        length[axis] += (loops[0][(i + 1) % loops[0].size()] - loops[0][i]).norm();
        count[axis] += 1.0;
    }
    const Vec2 spacing = length.cwiseQuotient(count);
    std::vector<LatticeFacet<2>> facets;
    add_facets(placed[0], 0, facets);
    std::set<LatticePoint<2>> taken(placed[0].points.begin(), placed[0].points.end());
    const LogicalGrid<2> outer(facets);
    bool fits = outer.ok() && taken.size() == loops[0].size();
    std::size_t l = 0;
    while (fits && ++l < loops.size()) {
        const std::complex<double> turn = polygon_s(loops[l], trace_polygon(classes[l], 0, l)) * std::conj(s);
        const int first = static_cast<int>(std::lround(std::arg(turn) / std::acos(0.0)));
        LatticeLoop hole = trace_polygon(classes[l], (first + 4) % 4, l);
        fits = place_hole(hole, estimate_lattice(loops[l][0], s, spacing, loops, placed), options.max_shift, facets,
                          taken, static_cast<Index>(l));
        add_facets(hole, static_cast<Index>(l), facets);
        placed.push_back(std::move(hole));
    }
    if (!fits) {
        throw UnmeshableError(ErrorCode::not_submappable,
                              l == 0 ? "the outer loop overlaps itself on the lattice"
                                     : "loop " + std::to_string(l) + " finds no room on the lattice between the others",
                              {static_cast<std::int64_t>(l)});
    }
    return placed;
}

}  // namespace detail

PAVIOR_INLINE PolygonQuads submap_polygon(std::span<const std::vector<Vec2>> loops,
                                          std::span<const std::vector<CornerClass>> classes,
                                          const SubmapPolygonOptions& options) {
    if (loops.empty() || classes.size() != loops.size()) {
        throw InputError(loops.empty() ? ErrorCode::empty_input : ErrorCode::size_mismatch,
                         "a polygon needs an outer loop, and classes for each loop");
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const auto id = static_cast<std::int64_t>(l);
        if (loops[l].size() < 4 || classes[l].size() != loops[l].size()) {
            throw InputError(loops[l].size() < 4 ? ErrorCode::empty_input : ErrorCode::size_mismatch,
                             "loop " + std::to_string(l) + " needs at least four points and a class for each", {id});
        }
        for (const Vec2& p : loops[l]) {
            if (!p.allFinite()) {
                throw InputError(ErrorCode::not_finite, "loop " + std::to_string(l) + " has a point that is not finite",
                                 {id});
            }
        }
    }
    const std::vector<detail::LatticeLoop> placed = detail::place_loops(loops, classes, options);
    std::vector<LatticeFacet<2>> facets;
    for (std::size_t l = 0; l < placed.size(); ++l) {
        detail::add_facets(placed[l], static_cast<Index>(l), facets);
    }
    const LogicalGrid<2> grid(facets);
    PolygonQuads result;
    result.classes.assign(classes.begin(), classes.end());
    result.nodes.assign(grid.node_count(), Vec2::Zero());
    std::vector<std::uint8_t> fixed(grid.node_count(), 0);
    detail::LayerWidths<2> widths(grid);
    std::array<std::set<int>, 2> planes;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        result.loops.emplace_back();
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            const LatticePoint<2>& p = placed[l].points[i];
            const Index node = grid.node(p);
            result.loops.back().push_back(node);
            result.nodes[node] = loops[l][i];
            fixed[node] = 1;
            const auto axis = static_cast<std::size_t>(placed[l].heading[i] % 2);
            widths.add(axis, p[axis] - (placed[l].heading[i] < 2 ? 0 : 1),
                       (loops[l][(i + 1) % loops[l].size()] - loops[l][i]).norm());
            if (classes[l][i] != CornerClass::side) {
                planes[0].insert(p[0]);
                planes[1].insert(p[1]);
            }
        }
    }
    LatticeLayers<2> layers{widths.take(), {}};
    for (std::size_t a = 0; a < 2; ++a) {
        layers.planes[a].assign(planes[a].begin(), planes[a].end());
    }
    place_inner_nodes(grid, layers, result.nodes);
    grid.for_each_node([&](Index, const LatticePoint<2>& p) { result.lattice.push_back(p); });
    grid.for_each_cell([&](const LatticePoint<2>& c) {
        result.quads.push_back(
            {grid.node(c), grid.node({c[0] + 1, c[1]}), grid.node({c[0] + 1, c[1] + 1}), grid.node({c[0], c[1] + 1})});
    });
    if (options.repair) {
        result.smooth = untangle_quads(result.nodes, result.quads, fixed);
    }
    return result;
}

PAVIOR_INLINE PolygonQuads submap_polygon(std::span<const std::vector<Vec2>> loops,
                                          const SubmapPolygonOptions& options) {
    std::vector<std::vector<CornerClass>> classes;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        auto found = loops[l].size() < 3
                         ? std::nullopt
                         : classify_loop(detail::interior_angles(loops[l]), l == 0 ? 4 : -4, options.corners);
        if (!found) {
            throw UnmeshableError(
                ErrorCode::not_submappable,
                "the corners of loop " + std::to_string(l) + " are not those of a union of rectangles",
                {static_cast<std::int64_t>(l)});
        }
        classes.push_back(std::move(found->classes));
    }
    return submap_polygon(loops, classes, options);
}

}  // namespace pavior
