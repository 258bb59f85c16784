#pragma once

#include <pavior/brep/edge_mesh.hpp>
#include <pavior/brep/nearest_edge.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/decompose/edge_angles.hpp>
#include <pavior/part/detail/hex_jacobian.hpp>
#include <pavior/part/entity_guide.hpp>
#include <pavior/part/settle_nodes.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Feature edges one after the other, through vertices where no other one ends.
struct FeaturePath {
    std::vector<OrientedEdge> edges;
    std::vector<VertexId> vertices;  ///< one more than edges; of a loop the first again
};

/// The paths of two edges and more.
[[nodiscard]] inline std::vector<FeaturePath> feature_paths(const AnyModel& b, const std::set<EdgeId>& features) {
    std::map<VertexId, std::vector<EdgeId>> at;
    for (const EdgeId e : features) {
        for (const VertexId v : b.edge_vertices(e)) {
            at[v].push_back(e);
        }
    }
    const auto passed = [&](VertexId v) { return at[v].size() == 2 && at[v][0] != at[v][1]; };
    std::set<EdgeId> used;
    std::vector<FeaturePath> result;
    const auto follow = [&](EdgeId first, VertexId from) {
        FeaturePath path{{}, {from}};
        for (EdgeId e = first; used.insert(e).second;) {
            const std::array<VertexId, 2> ends = b.edge_vertices(e);
            const bool forward = ends[0] == path.vertices.back();
            path.edges.push_back({e, forward});
            path.vertices.push_back(ends[forward ? 1 : 0]);
            const std::vector<EdgeId>& next = at[path.vertices.back()];
            if (!passed(path.vertices.back())) {
                break;
            }
            e = next[next[0] == e ? 1 : 0];
        }
        if (path.edges.size() > 1) {
            result.push_back(std::move(path));
        }
    };
    for (const bool loops : {false, true}) {
        for (const EdgeId e : features) {
            for (const VertexId v : b.edge_vertices(e)) {
                if (!used.contains(e) && (loops || !passed(v))) {
                    follow(e, v);
                }
            }
        }
    }
    return result;
}

class NodeSettler {
public:
    NodeSettler(const AnyModel& b, const SettleOptions& options, SolidsMesh& mesh)
        : b_(b), options_(options), mesh_(mesh), before_(mesh.mesh.nodes) {}

    SettledNodes run() {
        on_ = node_entities(b_, mesh_.mesh.nodes, mesh_.mesh.hexes, mesh_.hex_solid, mesh_.quads, mesh_.quad_face)
                  .of_node;
        leave_smooth_edges();
        for (std::size_t h = 0; h < mesh_.mesh.hexes.size(); ++h) {
            const double now = scaled_jacobian(mesh_.mesh, h);
            limit_.push_back(now > 0 ? std::min(0.02, 0.5 * now) : now);
        }
        targets_ = before_;
        std::vector<char> moved(before_.size(), 0);
        aim(moved);
        mesh_.mesh.nodes = targets_;
        if (!good() && !good_improved(false) && !good_improved(true)) {
            mesh_.mesh.nodes = targets_;
            back_off(moved);
        }
        return result();
    }

private:
    [[nodiscard]] bool off(std::size_t i, const Vec3& x, double within) const {
        return !((entity_point(b_, on_[i]) - x).norm() <= within * options_.size);
    }

    /// The edges between faces of one surface are none for the mesh unless it has a node there.
    void leave_smooth_edges() {
        std::set<EdgeId> smooth;
        for (const SolidId s : std::set<SolidId>(mesh_.hex_solid.begin(), mesh_.hex_solid.end())) {
            for (const EdgeAngle& angle : edge_angles(b_, s)) {
                (angle.smooth() ? smooth : features_).insert(angle.edge);
            }
        }
        std::vector<char> astray(on_.size(), 0);
        for (std::size_t i = 0; i < on_.size(); ++i) {
            const bool at_smooth = on_[i].dimension == 1 && smooth.contains(EdgeId{on_[i].id});
            astray[i] = at_smooth && off(i, before_[i], 1e-3) ? 1 : 0;
        }
        std::vector<double> distance(on_.size(), std::numeric_limits<double>::infinity());
        for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
            for (const Index i : mesh_.quads[q]) {
                if (astray[i] == 0) {
                    continue;
                }
                const FaceId f = mesh_.quad_face[q];
                const Vec2 uv = b_.closest_on_face(f, before_[i]);
                if (const double d = (b_.face_point(f, uv) - before_[i]).norm(); d < distance[i]) {
                    distance[i] = d;
                    on_[i] = {2, f.value, uv};
                }
            }
        }
    }

    /// Where nodes go that are near enough.
    void aim(std::vector<char>& moved) {
        for (const Index i : IndexRange(on_.size())) {
            if (on_[i].dimension > 2 || on_[i].id < 0) {
                continue;
            }
            const bool feature = on_[i].dimension < 2;
            const Vec3 to = entity_point(b_, on_[i]);
            const double distance = (to - before_[i]).norm();
            if (distance < (feature ? options_.near_feature : options_.near) * options_.size) {
                moved[i] = 1;
                targets_[i] = distance < 1e-10 * options_.size ? before_[i] : to;
            }
        }
        gather();
        for (const FeaturePath& path : feature_paths(b_, features_)) {
            space_out(path, moved);
        }
    }

    /// The nodes of each vertex and edge.
    void gather() {
        for (const Index i : IndexRange(on_.size())) {
            if (on_[i].dimension == 1) {
                nodes_on_[EdgeId{on_[i].id}].emplace_back(on_[i].uv[0], i);
            } else if (on_[i].dimension == 0 && on_[i].id >= 0) {
                node_at_.emplace(VertexId{on_[i].id}, i);
            }
        }
        for (auto& [e, nodes] : nodes_on_) {
            std::sort(nodes.begin(), nodes.end());
        }
    }

    /// The nodes along a path, if the mesh has them and passes a vertex of it by.
    void space_out(const FeaturePath& path, std::vector<char>& moved) {
        const auto at_vertex = [&](VertexId v) {
            const auto found = node_at_.find(v);
            return found != node_at_.end() && moved[found->second] != 0 ? found->second : no_index;
        };
        std::vector<Index> line{at_vertex(path.vertices.front())};
        bool passed_by = false;
        for (std::size_t k = 0; k < path.edges.size(); ++k) {
            std::vector<std::pair<double, Index>> nodes = nodes_on_[path.edges[k].edge];
            if (!path.edges[k].forward) {
                std::reverse(nodes.begin(), nodes.end());
            }
            for (const auto& [t, i] : nodes) {
                line.push_back(i);
            }
            const VertexId v = path.vertices[k + 1];
            const Index there = at_vertex(v);
            passed_by = passed_by || there == no_index || off(there, before_[there], 1e-3);
            if (there != no_index) {
                line.push_back(there);
            }
        }
        const bool ends = line.front() != no_index && at_vertex(path.vertices.back()) != no_index;
        if (!passed_by || !ends || line.size() <= path.edges.size() ||
            std::any_of(line.begin(), line.end(), [&](Index i) { return moved[i] == 0; })) {
            return;
        }
        std::vector<double> reach{0};
        for (std::size_t i = 1; i < line.size(); ++i) {
            reach.push_back(reach.back() + (before_[line[i]] - before_[line[i - 1]]).norm());
        }
        const std::vector<std::size_t> stops = nearest_stops(path, reach);
        for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
            const auto& [e, forward] = path.edges[k];
            put(line[stops[k]], {0, path.vertices[k].value, Vec2::Zero()});
            std::vector<double> fractions;
            for (std::size_t i = stops[k] + 1; i < stops[k + 1]; ++i) {
                const double part = (reach[i] - reach[stops[k]]) / (reach[stops[k + 1]] - reach[stops[k]]);
                fractions.push_back(forward ? part : 1 - part);
            }
            if (!forward) {
                std::reverse(fractions.begin(), fractions.end());
            }
            const std::vector<double> places = edge_parameters(b_, e, fractions);
            for (std::size_t j = 0; j < places.size(); ++j) {
                put(line[stops[k] + 1 + (forward ? j : places.size() - 1 - j)], {1, e.value, {places[j], 0}});
            }
        }
    }

    /// Which of the nodes of a line, at \p reach along it, becomes which vertex of a path: those that move least, with
    /// two intervals between for each right angle that the path turns.
    [[nodiscard]] std::vector<std::size_t> nearest_stops(const FeaturePath& path, const std::vector<double>& reach) {
        std::vector<double> at{0};
        std::vector<std::size_t> between;
        for (const OrientedEdge& use : path.edges) {
            at.push_back(at.back() + b_.edge_length(use.edge));
            between.push_back(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(turn(use.edge) / 45))));
        }
        const std::size_t n = reach.size();
        for (std::size_t k = between.size(); std::accumulate(between.begin(), between.end(), std::size_t{0}) >= n;) {
            k = k > 0 ? k - 1 : between.size() - 1;  // too few for all
            between[k] = std::max<std::size_t>(1, between[k] - 1);
        }
        constexpr double never = std::numeric_limits<double>::infinity();
        std::vector<std::vector<double>> cost(at.size(), std::vector<double>(n, never));
        std::vector<std::vector<std::size_t>> from(at.size(), std::vector<std::size_t>(n, 0));
        cost[0][0] = 0;
        for (std::size_t k = 1; k < at.size(); ++k) {
            double best = never;
            std::size_t best_at = 0;
            for (std::size_t i = between[k - 1]; i < n; ++i) {
                const std::size_t last = i - between[k - 1];
                if (cost[k - 1][last] < best) {
                    best = cost[k - 1][last];
                    best_at = last;
                }
                const double move = reach[i] * at.back() / reach.back() - at[k];
                cost[k][i] = best + move * move;
                from[k][i] = best_at;
            }
        }
        std::vector<std::size_t> stops(at.size(), n - 1);
        for (std::size_t k = at.size() - 1; k > 0; --k) {
            stops[k - 1] = from[k][stops[k]];
        }
        return stops;
    }

    /// By which the tangent of an edge turns, degrees.
    [[nodiscard]] double turn(EdgeId e) const {
        const std::array<double, 2> range = b_.edge_range(e);
        double sum = 0;
        Vec3 way = b_.edge_derivative(e, range[0]);
        for (int k = 1; k <= 8; ++k) {
            const Vec3 next = b_.edge_derivative(e, range[0] + k / 8.0 * (range[1] - range[0]));
            sum += std::atan2(way.cross(next).norm(), way.dot(next));
            way = next;
        }
        return sum * 180 / std::numbers::pi;
    }

    void put(Index i, const NodeEntity& entity) {
        on_[i] = entity;
        targets_[i] = entity_point(b_, entity);
    }

    [[nodiscard]] bool good() const {
        for (std::size_t h = 0; h < limit_.size(); ++h) {
            if (!(scaled_jacobian(mesh_.mesh, h) >= limit_[h])) {
                return false;
            }
        }
        return true;
    }

    /// Improves hexahedra by inner nodes, or also by nodes that slide on their entities.
    [[nodiscard]] bool good_improved(bool sliding) {
        check_stop(options_.execution.stop);
        std::vector<NodeEntity> on = on_;
        for (std::size_t i = 0; i < on.size(); ++i) {
            const bool slides = sliding && on[i].id >= 0 && !off(i, mesh_.mesh.nodes[i], 1e-6);
            on[i] = on[i].dimension < 3 && !slides ? held_node() : on[i];
        }
        ImproveOptions own;
        own.target = own.sufficient = 0.3;
        own.effort = 30;
        own.execution = options_.execution;
        const EntityGuide guide(b_, std::move(on), 1e-8 * options_.size);
        improve_hexes(std::span(mesh_.mesh.nodes), std::span<const HexCorners>(mesh_.mesh.hexes), guide, own);
        return good();
    }

    void back_off(std::vector<char>& moved) {
        std::vector<Vec3>& x = mesh_.mesh.nodes;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t h = 0; h < limit_.size(); ++h) {
                const HexCorners& c = mesh_.mesh.hexes[h];
                const bool any = std::any_of(c.begin(), c.end(), [&](Index i) { return moved[i] != 0; });
                if (!any || scaled_jacobian(mesh_.mesh, h) >= limit_[h]) {
                    continue;
                }
                for (const Index i : c) {
                    x[i] = before_[i];
                    moved[i] = 0;
                }
                changed = true;
            }
        }
    }

    /// Of nodes that have slid.
    void find_parameters() {
        NearestEdge<AnyModel> near_edge(b_);
        for (std::size_t i = 0; i < on_.size(); ++i) {
            const Vec3& x = mesh_.mesh.nodes[i];
            const bool slid = on_[i].dimension == 1 || on_[i].dimension == 2;
            if (!slid || !off(i, x, 1e-9)) {
                continue;
            }
            if (on_[i].dimension == 1) {
                on_[i].uv[0] = near_edge.closest(EdgeId{on_[i].id}, x).t;
            } else if (const auto foot = surface_foot(b_, FaceId{on_[i].id}, x, on_[i].uv, 1e-8 * options_.size)) {
                on_[i].uv = foot->uv;
            }
        }
    }

    [[nodiscard]] SettledNodes result() {
        SettledNodes result;
        find_parameters();
        for (std::size_t i = 0; i < on_.size(); ++i) {
            if (on_[i].dimension < 3 && (on_[i].id < 0 || off(i, mesh_.mesh.nodes[i], 1e-4))) {
                on_[i] = held_node();
                ++result.held;
            }
        }
        result.of_node = std::move(on_);
        result.min_jacobian = least_scaled_jacobian(mesh_.mesh);
        return result;
    }

    const AnyModel& b_;
    const SettleOptions& options_;
    SolidsMesh& mesh_;
    std::vector<Vec3> before_, targets_;
    std::vector<NodeEntity> on_;
    std::vector<double> limit_;
    std::set<EdgeId> features_;
    std::map<VertexId, Index> node_at_;
    std::map<EdgeId, std::vector<std::pair<double, Index>>> nodes_on_;  ///< by their parameters
};

}  // namespace detail

PAVIOR_INLINE SettledNodes settle_nodes(const AnyModel& b, SolidsMesh& mesh, const SettleOptions& options) {
    if (!(options.size > 0) || !(options.near >= 0) || !(options.near_feature >= 0)) {
        throw InputError(ErrorCode::bad_option, "settle_nodes: a size above 0 and distances of 0 or more expected");
    }
    return detail::NodeSettler(b, options, mesh).run();
}

}  // namespace pavior
