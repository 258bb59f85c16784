#pragma once
/// \file
/// Paths of sweeps, found from the edges along which a solid was swept.

#include <pavior/brep/edge_chain.hpp>
#include <pavior/brep/face_corners.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/spine.hpp>
#include <pavior/many_to_many/unrolled_brep.hpp>
#include <pavior/math/box.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Edges that go on smoothly, from end to end of a path.
template <brep B>
class SweepPaths {
public:
    SweepPaths(const B& b, std::span<const SolidId> solids) : b_(b) {
        std::vector<EdgeId> edges;
        for (const FaceId f : faces_of(b, solids)) {
            for (const EdgeLoop& loop : b.face_loops(f)) {
                for (const OrientedEdge& use : loop) {
                    edges.push_back(use.edge);
                }
            }
        }
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        for (const EdgeId e : edges) {
            add(e);
        }
        for (std::size_t i = 0; i < ribs_.size(); ++i) {
            starts_[ribs_[i].ends[0]].push_back(i);
        }
    }

    /// Longest first.
    [[nodiscard]] std::vector<EdgeChain> run() const {
        std::vector<std::pair<double, EdgeChain>> found;
        std::vector<char> used(b_.edge_count(), 0);
        for (std::size_t i = 0; i < ribs_.size(); i += 2) {
            if (used[ribs_[i].use.edge.index()] != 0 || !ribs_[i].curved) {
                continue;
            }
            const std::vector<std::size_t> chain = chain_of(i);
            double length = 0.0;
            EdgeChain edges;
            for (const std::size_t rib : chain) {
                used[ribs_[rib].use.edge.index()] = 1;
                length += ribs_[rib].length;
                edges.push_back(ribs_[rib].use);
            }
            if (!edges.empty()) {
                found.emplace_back(-length, std::move(edges));
            }
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& c) { return a.first < c.first; });
        std::vector<EdgeChain> result;
        for (auto& [length, chain] : found) {
            result.push_back(std::move(chain));
        }
        return result;
    }

private:
    /// An edge run one way; the other way follows or precedes it.
    struct Rib {
        OrientedEdge use;
        std::array<VertexId, 2> ends;
        std::array<Vec3, 2> points, tangents;
        double length = 0.0;
        bool curved = false;
    };
    static constexpr double smooth = 1e-3;  ///< sine of the angle between edges that go on smoothly, at most

    void add(EdgeId e) {
        constexpr int steps = 8;
        const auto range = b_.edge_range(e);
        Rib rib{{e, true}, b_.edge_vertices(e), {}, {}, 0.0, false};
        if (rib.ends[0] == rib.ends[1]) {
            return;
        }
        Vec3 before = Vec3::Zero();
        for (int i = 0; i <= steps; ++i) {
            const double t = range[0] + (range[1] - range[0]) * i / steps;
            const Vec3 slope = b_.edge_derivative(e, t);
            const Vec3 point = b_.edge_point(e, t);
            if (!(slope.norm() > 0.0) || !slope.allFinite()) {
                return;
            }
            if (i == 0 || i == steps) {
                rib.points[i == 0 ? 0 : 1] = point;
                rib.tangents[i == 0 ? 0 : 1] = slope.normalized();
            }
            rib.length += i == 0 ? 0.0 : (point - before).norm();
            rib.curved = rib.curved || slope.normalized().cross(rib.tangents[0]).norm() > 0.02;
            before = point;
        }
        if (!(rib.length > 0.0)) {
            return;
        }
        ribs_.push_back(rib);
        std::swap(rib.ends[0], rib.ends[1]);
        std::swap(rib.points[0], rib.points[1]);
        std::swap(rib.tangents[0], rib.tangents[1]);
        rib.tangents[0] *= -1.0;
        rib.tangents[1] *= -1.0;
        rib.use.forward = false;
        ribs_.push_back(rib);
    }

    /// The chain through rib i, empty if it is closed.
    [[nodiscard]] std::vector<std::size_t> chain_of(std::size_t i) const {
        std::vector<std::size_t> chain;
        std::vector<char> used(b_.edge_count(), 0);
        for (std::size_t rib = i ^ 1U; rib < ribs_.size(); rib = next(rib, used)) {
            chain.push_back(rib ^ 1U);
            used[ribs_[rib].use.edge.index()] = 1;
        }
        std::reverse(chain.begin(), chain.end());
        for (std::size_t rib = next(i, used); rib < ribs_.size(); rib = next(rib, used)) {
            chain.push_back(rib);
            used[ribs_[rib].use.edge.index()] = 1;
        }
        const Rib& first = ribs_[chain.front()];
        const Rib& last = ribs_[chain.back()];
        return first.ends[0] == last.ends[1] ? std::vector<std::size_t>{} : chain;
    }

    /// The rib that goes on from rib \p at: at its end, or else parallel to it, where the path steps aside. Past the
    /// last if there is none.
    [[nodiscard]] std::size_t next(std::size_t at, const std::vector<char>& used) const {
        const Rib& rib = ribs_[at];
        std::size_t best = ribs_.size();
        double least = smooth;
        for (const std::size_t k : starts_.at(rib.ends[1])) {
            const double turn = rib.tangents[1].cross(ribs_[k].tangents[0]).norm();
            if (k / 2 != at / 2 && rib.tangents[1].dot(ribs_[k].tangents[0]) > 0.0 && turn < least) {
                least = turn;
                best = k;
            }
        }
        if (best < ribs_.size()) {
            return used[ribs_[best].use.edge.index()] != 0 ? ribs_.size() : best;
        }
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < ribs_.size(); ++k) {
            const Vec3 aside = ribs_[k].points[0] - rib.points[1];
            if (used[ribs_[k].use.edge.index()] == 0 && rib.tangents[1].dot(ribs_[k].tangents[0]) > 0.0 &&
                rib.tangents[1].cross(ribs_[k].tangents[0]).norm() < smooth &&
                std::abs(aside.dot(rib.tangents[1])) < 1e-4 * rib.length && aside.norm() < nearest) {
                nearest = aside.norm();
                best = k;
            }
        }
        return best;
    }

    const B& b_;
    std::vector<Rib> ribs_;  ///< both ways of an edge, one after the other
    std::map<VertexId, std::vector<std::size_t>> starts_;
};

/// The curve of a chain; where it steps aside, it goes on in parallel.
template <brep B>
[[nodiscard]] Spine spine_of(const B& b, std::span<const OrientedEdge> chain, double per_radian) {
    constexpr std::size_t steps = 200;  // of an edge
    Spine spine(per_radian);
    std::vector<Vec3> points;
    std::vector<Vec3> tangents;
    for (const OrientedEdge& use : chain) {
        const auto range = b.edge_range(use.edge);
        points.clear();
        tangents.clear();
        for (std::size_t i = 0; i <= steps; ++i) {
            const double part = static_cast<double>(use.forward ? i : steps - i) / steps;
            const double t = range[0] + (range[1] - range[0]) * part;
            points.push_back(b.edge_point(use.edge, t));
            tangents.emplace_back((use.forward ? 1.0 : -1.0) * b.edge_derivative(use.edge, t).normalized());
        }
        spine.append(points, tangents);
    }
    return spine;
}

}  // namespace detail

/// Chains of edges along which \p solids may have been swept, longest first: edges, at least one of them curved, each
/// of which goes on where the one before ends, in its direction. Where no edge does so, the chain goes on along the
/// nearest edge that starts in the same normal plane in that direction: the path steps aside at a cap. Closed chains
/// are left out. O(e^2) for e edges.
template <brep B>
[[nodiscard]] std::vector<EdgeChain> sweep_paths(const B& b, std::span<const SolidId> solids) {
    return detail::SweepPaths<B>(b, solids).run();
}

/// The curve parallel to \p chain, in the middle of \p solids, along which they may have been swept; heights grow by at
/// least \p size for each \p max_angle degrees that it turns. Nothing if the solids reach the centres of its curvature.
/// O(edges), 128 points each.
template <brep B>
[[nodiscard]] std::optional<Spine> spine_along(const B& b, std::span<const SolidId> solids,
                                               std::span<const OrientedEdge> chain, double size,
                                               double max_angle = 45) {
    constexpr double least_stretch = 0.05;
    const Spine rib = detail::spine_of(b, chain, size * detail::degrees_per_radian / max_angle);
    Box<Vec3> box;
    double least = 1.0;
    detail::for_each_boundary_point(b, solids, [&](const Vec3& p) {
        box.add(rib.unrolled(p));
        least = std::min(least, rib.stretch(p));
    });
    if (!(least > least_stretch)) {
        return std::nullopt;
    }
    const Vec3 middle = 0.5 * (box.low + box.high);
    return rib.parallel(middle[0], middle[1]);
}

}  // namespace pavior
