#include <pavior/imprint/imprint.hpp>

#include "crossings.hpp"
#include "snap.hpp"

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace pavior {

namespace {

using detail::Routes;
using detail::Walk;
using Step = std::pair<Index, Index>;

void check(const PlaneCurves& curves, const ImprintOptions& options) {
    const auto bad = [](double tolerance) { return !(tolerance > 0) || !std::isfinite(tolerance); };
    if (bad(options.coincident) || std::any_of(options.merge.begin(), options.merge.end(), bad)) {
        throw InputError(ErrorCode::bad_option, "ImprintOptions: the tolerances must be positive and finite");
    }
    if (!options.merge.empty() && options.merge.size() != curves.size()) {
        throw InputError(ErrorCode::size_mismatch, "ImprintOptions::merge: one tolerance a curve expected, or none");
    }
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const Error::Ids ids{static_cast<std::int64_t>(c)};
        if (curves[c].size() < 2) {
            throw InputError(ErrorCode::empty_input, "curve " + std::to_string(c) + " has fewer than two points", ids);
        }
        for (const Vec2& x : curves[c]) {
            if (!x.allFinite()) {
                throw InputError(ErrorCode::not_finite,
                                 "curve " + std::to_string(c) + " has a point that is not finite", ids);
            }
        }
    }
}

Routes to_routes(const PlaneCurves& curves) {
    Routes routes;
    routes.points = curves.points;
    routes.corner.assign(curves.points.size(), 0);
    for (std::size_t c = 0; c < curves.size(); ++c) {
        std::vector<Index> route;
        for (std::size_t i = curves.offsets[c]; i < curves.offsets[c + 1]; ++i) {
            route.push_back(static_cast<Index>(i));
        }
        routes.corner[route.front()] = 1;
        routes.corner[route.back()] = 1;
        routes.routes.push_back(std::move(route));
    }
    return routes;
}

std::size_t steps(const Routes& routes) {
    std::size_t sum = 0;
    for (const std::vector<Index>& route : routes.routes) {
        sum += route.size();
    }
    return sum;
}

/// Snaps and cuts until nothing changes. Routes that grow beyond what crossings explain will not come to rest.
void settle(Routes& routes) {
    constexpr int rounds = 60;
    std::size_t most = std::numeric_limits<std::size_t>::max();
    for (int i = 0; i < rounds && steps(routes) < most; ++i) {
        bool changed = detail::merge_points(routes);
        changed = detail::bend_segments(routes) || changed;
        changed = detail::cut_crossings(routes) || changed;
        if (!changed) {
            return;
        }
        if (i == 3) {
            most = 2 * steps(routes) + 1000;
        }
    }
    throw Error(ErrorCode::cad_failure, "the curves could not be separated from each other");
}

/// Puts edges together from the segments between vertices.
class Assembler {
public:
    explicit Assembler(const Routes& routes) : routes_(routes), vertex_(routes.points.size(), no_index) {
        find_vertices();
        for (const std::vector<Index>& route : routes.routes) {
            add_route(route);
        }
    }

    PlaneArrangement finish() {
        for (const std::vector<Walk>& face : detail::faces(routes_)) {
            add_cell(face);
        }
        return std::move(result_);
    }

private:
    /// Ends of curves, and points with more or fewer than two neighbours. Where curves part, there are more.
    void find_vertices() {
        std::vector<Index> degree(routes_.points.size(), 0);
        for (const auto& [a, b] : routes_.segments()) {
            ++degree[a];
            ++degree[b];
        }
        is_vertex_.assign(routes_.points.size(), 0);
        for (std::size_t i = 0; i < degree.size(); ++i) {
            is_vertex_[i] = static_cast<char>(routes_.corner[i] != 0 || (degree[i] != 0 && degree[i] != 2));
        }
    }

    Index vertex(Index point) {
        if (vertex_[point] == no_index) {
            vertex_[point] = static_cast<Index>(result_.vertices.size());
            result_.vertices.push_back(routes_.points[point]);
        }
        return vertex_[point];
    }

    void add_route(const std::vector<Index>& route) {
        std::vector<OrientedPlaneEdge> edges;
        result_.ends.push_back({vertex(route.front()), vertex(route.back())});
        std::size_t first = 0;
        for (std::size_t i = 1; i < route.size(); ++i) {
            if (is_vertex_[route[i]] != 0) {
                edges.push_back(add_edge(std::span(route).subspan(first, i - first + 1)));
                first = i;
            }
        }
        result_.routes.push_back(std::move(edges));
    }

    OrientedPlaneEdge add_edge(std::span<const Index> chain) {
        if (const auto found = step_.find({chain[0], chain[1]}); found != step_.end()) {
            return found->second;
        }
        const auto id = static_cast<Index>(result_.edges.size());
        PlaneEdge edge;
        edge.vertices = {vertex(chain.front()), vertex(chain.back())};
        for (const Index i : chain) {
            edge.points.push_back(routes_.points[i]);
        }
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            step_[{chain[i], chain[i + 1]}] = {id, true};
            step_[{chain[i + 1], chain[i]}] = {id, false};
        }
        result_.edges.push_back(std::move(edge));
        return {id, true};
    }

    void add_cell(const std::vector<Walk>& face) {
        const auto id = static_cast<Index>(result_.cells.size());
        PlaneCell cell;
        for (const Walk& walk : face) {
            std::vector<OrientedPlaneEdge> loop;
            const std::size_t n = walk.size();
            std::size_t start = 0;
            while (is_vertex_[walk[start]] == 0) {
                ++start;
                PAVIOR_ASSERT(start < n);
            }
            for (std::size_t i = 0; i < n; ++i) {
                const Index from = walk[(start + i) % n];
                const OrientedPlaneEdge use = step_.at({from, walk[(start + i + 1) % n]});
                if (is_vertex_[from] != 0) {
                    loop.push_back(use);
                    result_.edges[use.edge].cells[use.forward ? 0 : 1] = id;
                }
            }
            cell.loops.push_back(std::move(loop));
        }
        cell.inside = inside(cell);
        result_.cells.push_back(std::move(cell));
    }

    /// Half way from the middle of the longest segment of the boundary to the next one across the cell.
    [[nodiscard]] Vec2 inside(const PlaneCell& cell) const {
        std::vector<std::array<Vec2, 2>> segments;
        for (const auto& loop : cell.loops) {
            for (const OrientedPlaneEdge& use : loop) {
                const std::vector<Vec2>& x = result_.edges[use.edge].points;
                for (std::size_t i = 0; i + 1 < x.size(); ++i) {
                    segments.push_back(use.forward ? std::array{x[i], x[i + 1]} : std::array{x[i + 1], x[i]});
                }
            }
        }
        const auto length = [](const std::array<Vec2, 2>& s) { return (s[1] - s[0]).squaredNorm(); };
        const auto longest = *std::max_element(segments.begin(), segments.end(),
                                               [&](const auto& a, const auto& b) { return length(a) < length(b); });
        const Vec2 from = 0.5 * (longest[0] + longest[1]);
        const Vec2 along = longest[1] - longest[0];
        const Vec2 inward(-along.y(), along.x());
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& s : segments) {
            const Vec2 x = s[1] - s[0];
            const double det = inward.x() * x.y() - inward.y() * x.x();
            const Vec2 to = s[0] - from;
            if (det != 0) {
                const double t = (to.x() * x.y() - to.y() * x.x()) / det;
                const double at = (to.x() * inward.y() - to.y() * inward.x()) / det;
                if (t > 1e-9 && at >= -1e-12 && at <= 1 + 1e-12) {
                    nearest = std::min(nearest, t);
                }
            }
        }
        return std::isfinite(nearest) ? Vec2(from + 0.5 * nearest * inward) : from;
    }

    const Routes& routes_;
    std::vector<char> is_vertex_;
    std::vector<Index> vertex_;
    std::map<Step, OrientedPlaneEdge> step_;
    PlaneArrangement result_;
};

}  // namespace

PlaneArrangement imprint(const PlaneCurves& curves, const ImprintOptions& options) {
    check(curves, options);
    Routes routes = to_routes(curves);
    if (routes.routes.empty()) {
        return {};
    }
    routes.tolerance.assign(curves.size(), options.coincident);
    settle(routes);
    for (std::size_t c = 0; c < options.merge.size(); ++c) {
        routes.tolerance[c] = std::max(options.coincident, options.merge[c]);
    }
    settle(routes);
    return Assembler(routes).finish();
}

}  // namespace pavior
