#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/groups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Largest distance of the triangles and the chain of a front from a surface.
[[nodiscard]] inline double reach(const PatchSurface& s, const Front& front, const FrontBoundary& boundary,
                                  std::span<const Vec3> nodes) {
    double most = 0;
    for (const Index t : front.region) {
        for (const Index i : boundary.surface.triangles[t]) {
            most = std::max(most, std::abs(s.distance(nodes[i])));
        }
    }
    return most;
}

[[nodiscard]] inline double distance_to_axis(const PatchSurface& s, const Vec3& x) {
    const Vec3 d = x - s.point;
    return (d - s.axis.dot(d) * s.axis).norm();
}

/// True if two curved surfaces of one kind agree.
[[nodiscard]] inline bool same_curved(const PatchSurface& a, const PatchSurface& b, double tolerance) {
    const auto near = [&](double x, double y) { return std::abs(x - y) <= tolerance; };
    if (a.kind == SurfaceKind::sphere) {
        return (a.point - b.point).norm() <= tolerance && near(a.radius, b.radius);
    }
    if (std::abs(a.axis.dot(b.axis)) < 1 - 1e-6) {
        return false;
    }
    if (a.kind == SurfaceKind::cylinder) {
        return distance_to_axis(a, b.point) <= tolerance && near(a.radius, b.radius);
    }
    const bool here = (a.point - b.point).norm() <= tolerance;
    return here && (a.kind == SurfaceKind::cone ? std::abs(a.radius - b.radius) < 1e-4
                                                : near(a.radius, b.radius) && near(a.tube, b.tube));
}

/// True if the fronts lie on one surface.
[[nodiscard]] inline bool same_surface(const Front& a, const Front& b, const FrontBoundary& boundary,
                                       std::span<const Vec3> nodes, double tolerance) {
    if (a.surface.kind != b.surface.kind) {
        return false;
    }
    if (a.surface.kind == SurfaceKind::facets) {
        return a.region == b.region;
    }
    if (a.surface.kind != SurfaceKind::plane) {
        return same_curved(a.surface, b.surface, 20 * tolerance);
    }
    return std::abs(a.surface.axis.dot(b.surface.axis)) > 0.9999 &&
           std::min(reach(a.surface, b, boundary, nodes), reach(b.surface, a, boundary, nodes)) <= 4 * tolerance;
}

[[nodiscard]] inline Vec3 middle_of_chain(const Front& front, std::span<const Vec3> nodes) {
    const std::size_t k = (front.chain.size() - 1) / 2;
    return 0.5 * (nodes[front.chain[k]] + nodes[front.chain[k + 1]]);
}

[[nodiscard]] inline double area_of(const Front& front, const FrontBoundary& boundary) {
    double area = 0;
    for (const Index t : front.region) {
        area += boundary.facets[t].area;
    }
    return area;
}

/// The classes of fronts on one surface; the surface is that of the largest front.
[[nodiscard]] inline std::vector<SheetMember> exact_members(std::span<const Front> fronts,
                                                            const FrontBoundary& boundary, std::span<const Vec3> nodes,
                                                            double tolerance) {
    DisjointSets sets(fronts.size());
    for (const Index i : IndexRange(fronts.size())) {
        for (Index j = i + 1; j < fronts.size(); ++j) {
            if (sets.root(i) != sets.root(j) && same_surface(fronts[i], fronts[j], boundary, nodes, tolerance)) {
                sets.unite(i, j);
            }
        }
    }
    std::vector<Index> id;
    std::vector<SheetMember> members(number_sets(sets, id, [](Index) { return true; }));
    for (const Index i : IndexRange(fronts.size())) {
        members[id[i]].fronts.push_back(i);
    }
    for (SheetMember& member : members) {
        const Index largest = *std::max_element(member.fronts.begin(), member.fronts.end(), [&](Index a, Index b) {
            return area_of(fronts[a], boundary) < area_of(fronts[b], boundary);
        });
        member.surface = fronts[largest].surface;
        for (const Index f : member.fronts) {
            member.surface.sagitta = std::max(member.surface.sagitta, fronts[f].surface.sagitta);
        }
    }
    return members;
}

/// True if the segment meets the boundary between its ends.
[[nodiscard]] inline bool blocked(const Vec3& from, const Vec3& to, const FrontBoundary& boundary,
                                  std::span<const Vec3> nodes) {
    const Vec3 d = to - from;
    for (const TriCorners& c : boundary.surface.triangles) {
        const Vec3 a = nodes[c[0]];
        const Vec3 u = nodes[c[1]] - a;
        const Vec3 v = nodes[c[2]] - a;
        const Vec3 n = u.cross(v);
        const double along = n.dot(d);
        if (std::abs(along) <= 1e-9 * n.norm() * d.norm()) {
            continue;
        }
        const double t = n.dot(a - from) / along;
        const Vec3 x = from + t * d - a;
        const double p = n.dot(x.cross(v)) / n.squaredNorm();
        const double q = n.dot(u.cross(x)) / n.squaredNorm();
        if (t > 0.02 && t < 0.98 && p >= 0 && q >= 0 && p + q <= 1) {
            return true;
        }
    }
    return false;
}

/// The nearest point of a chain and the direction in which its sheet leaves there.
struct ChainPoint {
    Vec3 point{0, 0, 0};
    Vec3 ahead{0, 0, 0};
    double distance = std::numeric_limits<double>::infinity();
};

[[nodiscard]] inline ChainPoint nearest_on_chain(const Front& front, std::span<const Vec3> nodes, const Vec3& x) {
    ChainPoint best;
    for (std::size_t k = 0; k + 1 < front.chain.size(); ++k) {
        const Vec3& a = nodes[front.chain[k]];
        const Vec3 d = nodes[front.chain[k + 1]] - a;
        const double t = std::clamp(d.dot(x - a) / std::max(d.squaredNorm(), 1e-300), 0.0, 1.0);
        const Vec3 p = a + t * d;
        if ((x - p).norm() < best.distance) {
            best = {p, front.ahead[k], (x - p).norm()};
        }
    }
    return best;
}

/// How far the middle of front `b` is ahead of front `a`, if it lies near the continuation of `a`.
[[nodiscard]] inline std::optional<double> sees(const Front& a, const Front& b, std::span<const Vec3> nodes,
                                                double angle) {
    const Vec3 x = middle_of_chain(b, nodes);
    const ChainPoint p = nearest_on_chain(a, nodes, x);
    const bool near = std::abs(a.surface.distance(x)) <= std::sin(angle) * p.distance;
    if (!near || !(p.distance > 0) || p.ahead.dot(x - p.point) < 0.3 * p.distance) {
        return std::nullopt;
    }
    return p.distance;
}

/// Surfaces that turn away from each other by less than this (half a degree) are parallel: they do not cross within the
/// solid, or were meant to.
constexpr double parallel_cosine = 0.99996;

/// Pairs of fronts that face each other on surfaces that are tilted a little, nearest partners first.
struct FacingPair {
    double distance = 0;
    Index a = 0;
    Index b = 0;
};

[[nodiscard]] inline std::vector<FacingPair> facing_pairs(std::span<const Front> fronts, const FrontBoundary& boundary,
                                                          std::span<const Vec3> nodes, double angle) {
    std::vector<FacingPair> pairs;
    for (const Index a : IndexRange(fronts.size())) {
        for (Index b = a + 1; b < fronts.size(); ++b) {
            const Front& fa = fronts[a];
            const Front& fb = fronts[b];
            if (fa.curve == fb.curve) {
                continue;
            }
            const Vec3 xa = middle_of_chain(fa, nodes);
            const Vec3 xb = middle_of_chain(fb, nodes);
            const double cosine = std::abs(fa.surface.normal(xa).dot(fb.surface.normal(xb)));
            const bool tilted = cosine >= std::cos(2 * angle) && cosine < parallel_cosine;
            const auto ab = tilted ? sees(fa, fb, nodes, angle) : std::nullopt;
            const auto ba = ab ? sees(fb, fa, nodes, angle) : std::nullopt;
            if (ab && ba && !blocked(xa, xb, boundary, nodes)) {
                pairs.push_back({std::max(*ab, *ba), a, b});
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const FacingPair& x, const FacingPair& y) { return x.distance < y.distance; });
    return pairs;
}

/// Unites members into groups and keeps track of their signs.
class GroupBuilder {
public:
    explicit GroupBuilder(std::vector<SheetMember> members)
        : members_(std::move(members)), group_(members_.size()), sign_(members_.size(), 1.0) {
        for (const Index m : IndexRange(members_.size())) {
            group_[m] = m;
        }
    }
    [[nodiscard]] Index member_of(Index front) const {
        for (const Index m : IndexRange(members_.size())) {
            if (std::binary_search(members_[m].fronts.begin(), members_[m].fronts.end(), front)) {
                return m;
            }
        }
        return no_index;
    }
    [[nodiscard]] const SheetMember& member(Index m) const { return members_[m]; }
    [[nodiscard]] bool same(Index a, Index b) const { return group_[a] == group_[b]; }
    /// `relative`: sign of b as seen from a.
    void unite(Index a, Index b, double relative) {
        const Index into = std::min(group_[a], group_[b]);
        const Index from = std::max(group_[a], group_[b]);
        if (into == from) {
            return;
        }
        const double flip = relative * sign_[a] * sign_[b];
        for (const Index m : IndexRange(members_.size())) {
            if (group_[m] == from) {
                group_[m] = into;
                sign_[m] *= flip;
            }
        }
    }
    [[nodiscard]] std::vector<SheetGroup> groups() const {
        std::vector<SheetGroup> result;
        for (const Index g : IndexRange(members_.size())) {
            SheetGroup group;
            for (const Index m : IndexRange(members_.size())) {
                if (group_[m] == g) {
                    group.members.push_back(members_[m]);
                    group.members.back().sign = sign_[m];
                }
            }
            if (!group.members.empty()) {
                result.push_back(std::move(group));
            }
        }
        return result;
    }

private:
    std::vector<SheetMember> members_;
    std::vector<Index> group_;
    std::vector<double> sign_;
};

/// The sheet that stands on a reversal curve: planes across the direction in which the material lies ahead.
[[nodiscard]] inline SheetGroup standing_sheet(std::span<const Front> fronts, Index first, Index second,
                                               std::span<const Vec3> nodes, double tolerance) {
    const Front& a = fronts[first];
    std::vector<Facet> facets;
    std::vector<Vec3> points;
    for (std::size_t k = 0; k + 1 < a.chain.size(); ++k) {
        const Vec3& x = nodes[a.chain[k]];
        const Vec3& y = nodes[a.chain[k + 1]];
        const Vec3 ahead = (a.ahead[k] + fronts[second].ahead[k]).stableNormalized();
        facets.push_back({0.5 * (x + y), ahead, (y - x).squaredNorm()});
        points.push_back(x);
        points.push_back(y);
    }
    SheetMember member;
    member.fronts = {first, second};
    member.surface.axis = mean_normal(facets).stableNormalized();
    member.surface.point = mean_centre(facets);
    if (!fit_holds(member.surface, facets, points, tolerance)) {
        member.surface.kind = SurfaceKind::facets;
        member.surface.facets = facets;
    }
    return {SheetKind::reversal, {member}};
}

}  // namespace detail

PAVIOR_INLINE std::vector<SheetGroup> sheet_groups(std::span<const Front> fronts, const FrontBoundary& boundary,
                                                   std::span<const Vec3> nodes, Grouping grouping, double tolerance,
                                                   double blend_angle) {
    detail::GroupBuilder builder(detail::exact_members(fronts, boundary, nodes, tolerance));
    const auto unite = [&](Index a, Index b) {
        const Vec3 x = detail::middle_of_chain(fronts[a], nodes);
        const Vec3 y = detail::middle_of_chain(fronts[b], nodes);
        const Index ma = builder.member_of(a);
        const Index mb = builder.member_of(b);
        const double along = builder.member(ma).surface.normal(x).dot(builder.member(mb).surface.normal(y));
        builder.unite(ma, mb, along < 0 ? -1.0 : 1.0);
    };
    std::vector<SheetGroup> standing;
    for (Index f = 0; f + 1 < fronts.size(); ++f) {
        if (fronts[f].kind == CurveKind::reversal && fronts[f + 1].curve == fronts[f].curve) {
            unite(f, f + 1);
            standing.push_back(detail::standing_sheet(fronts, f, f + 1, nodes, tolerance));
        }
    }
    if (grouping == Grouping::blended) {
        std::vector<char> paired(fronts.size(), 0);
        for (const detail::FacingPair& pair :
             detail::facing_pairs(fronts, boundary, nodes, blend_angle * std::numbers::pi / 180)) {
            if (paired[pair.a] == 0 || paired[pair.b] == 0) {
                paired[pair.a] = paired[pair.b] = 1;
                unite(pair.a, pair.b);
            }
        }
    }
    std::vector<SheetGroup> groups = builder.groups();
    groups.insert(groups.end(), standing.begin(), standing.end());
    return groups;
}

}  // namespace pavior
