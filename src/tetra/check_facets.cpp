#include "check_facets.hpp"

#include <pavior/core/disjoint_sets.hpp>

#include "facet_edges.hpp"
#include "plc.hpp"
#include "predicates.hpp"
#include "shells.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace pavior::detail {

namespace {

constexpr std::size_t most_intersections = 10000;

/// The checks in the order in which they can be made.
class Checker {
public:
    Checker(std::span<const Vec3> nodes, std::span<const TriCorners> facets, std::size_t boundary)
        : given_(nodes), facets_(facets), boundary_(facets.first(boundary)) {}

    SurfaceReport run() {
        if (boundary_.empty()) {
            add(SurfaceFault::empty, {}, {});
        }
        check_facets_alone();
        if (!report_.ok()) {
            return report_;
        }
        const Frame frame = frame_of(given_);
        for (const Vec3& x : given_) {
            nodes_.push_back(frame.inside(x));
        }
        check_use_of_nodes();
        check_areas();
        check_duplicates();
        check_places();
        check_edges();
        check_fans();
        const TriangleTree tree(nodes_, facets_);
        check_intersections(tree);
        if (report_.ok()) {
            check_shells();
        }
        return report_;
    }

private:
    void add(SurfaceFault fault, std::vector<Index> triangles, std::vector<Index> nodes) {
        report_.add(fault, {std::move(triangles), std::move(nodes)});
    }

    void check_facets_alone() {
        for (Index t = 0; t < facets_.size(); ++t) {
            const TriCorners& c = facets_[t];
            if (std::any_of(c.begin(), c.end(), [&](Index node) { return node >= given_.size(); })) {
                add(SurfaceFault::id_out_of_range, {t}, {});
                continue;
            }
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
                add(SurfaceFault::repeated_node, {t}, {});
            }
            if (std::any_of(c.begin(), c.end(), [&](Index node) { return !given_[node].allFinite(); })) {
                add(SurfaceFault::not_finite, {t}, {});
            }
        }
    }

    void check_use_of_nodes() {
        facet_at_.assign(nodes_.size(), no_index);
        for (Index t = static_cast<Index>(facets_.size()); t-- > 0;) {
            for (const Index node : facets_[t]) {
                facet_at_[node] = t;
            }
        }
        for (Index i = 0; i < nodes_.size(); ++i) {
            if (facet_at_[i] == no_index) {
                add(SurfaceFault::unused_node, {}, {i});
            }
        }
    }

    void check_areas() {
        degenerate_.assign(facets_.size(), 0);
        for (Index t = 0; t < facets_.size(); ++t) {
            const auto [x, y, z] = corners(t);
            const double longest = std::max({(y - x).norm(), (z - y).norm(), (x - z).norm()});
            if ((y - x).cross(z - x).norm() <= 1e-14 * longest * longest || collinear(x, y, z)) {
                degenerate_[t] = 1;
                add(SurfaceFault::degenerate, {t}, {});
            }
        }
    }

    void check_duplicates() {
        std::vector<std::pair<TriCorners, Index>> keys;
        keys.reserve(facets_.size());
        for (Index t = 0; t < facets_.size(); ++t) {
            TriCorners c = facets_[t];
            std::sort(c.begin(), c.end());
            keys.emplace_back(c, t);
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0; i < keys.size();) {
            std::vector<Index> same;
            const std::size_t begin = i;
            for (; i < keys.size() && keys[i].first == keys[begin].first; ++i) {
                same.push_back(keys[i].second);
            }
            if (same.size() > 1) {
                add(SurfaceFault::duplicate, std::move(same), {});
            }
        }
    }

    /// Nodes in one place get one number in place_.
    void check_places() {
        const auto key = [&](Index i) { return std::array{nodes_[i].x(), nodes_[i].y(), nodes_[i].z()}; };
        std::vector<Index> order(nodes_.size());
        for (Index i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [&](Index a, Index b) {
            const auto x = key(a);
            const auto y = key(b);
            return x != y ? x < y : a < b;
        });
        place_.resize(nodes_.size());
        std::vector<std::array<Index, 2>> pairs;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
            place_[order[i]] = same ? place_[order[i - 1]] : order[i];
            if (same && facet_at_[order[i]] != no_index && facet_at_[place_[order[i]]] != no_index) {
                pairs.push_back({place_[order[i]], order[i]});
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [a, b] : pairs) {
            add(SurfaceFault::coincident_nodes, {facet_at_[a], facet_at_[b]}, {a, b});
        }
    }

    void check_edges() {
        edges_ = facet_edges(boundary_);
        for_each_edge(edges_, [&](std::span<const FacetEdge> uses) {
            if (uses.size() == 2 && uses[0].forward != uses[1].forward) {
                return;
            }
            std::vector<Index> triangles;
            for (const FacetEdge& use : uses) {
                triangles.push_back(use.facet);
            }
            add(uses.size() == 1  ? SurfaceFault::open_edge
                : uses.size() > 2 ? SurfaceFault::overused_edge
                                  : SurfaceFault::same_sense,
                std::move(triangles), {uses[0].low, uses[0].high});
        });
    }

    /// Corners of triangles that share an edge at a node belong to one fan.
    void check_fans() {
        DisjointSets fans(3 * boundary_.size());
        const auto corner = [&](Index t, Index node) {
            const TriCorners& c = boundary_[t];
            return static_cast<Index>(3 * t + (c[0] == node ? 0 : c[1] == node ? 1 : 2));
        };
        for_each_edge(edges_, [&](std::span<const FacetEdge> uses) {
            for (const FacetEdge& use : uses) {
                fans.unite(corner(uses[0].facet, use.low), corner(use.facet, use.low));
                fans.unite(corner(uses[0].facet, use.high), corner(use.facet, use.high));
            }
        });
        std::vector<std::pair<Index, Index>> roots;  // node, smallest corner of a fan
        for (Index c = 0; c < 3 * boundary_.size(); ++c) {
            if (fans.root(c) == c) {
                roots.emplace_back(boundary_[c / 3][c % 3], c);
            }
        }
        std::sort(roots.begin(), roots.end());
        for (std::size_t i = 0; i < roots.size();) {
            const Index node = roots[i].first;
            std::vector<Index> triangles;
            for (; i < roots.size() && roots[i].first == node; ++i) {
                triangles.push_back(roots[i].second / 3);
            }
            if (triangles.size() > 1) {
                add(SurfaceFault::touching_node, std::move(triangles), {node});
            }
        }
    }

    void check_intersections(const TriangleTree& tree) {
        std::vector<std::array<Index, 2>> pairs;
        tree.boxes().for_each_pair([&](std::size_t a, std::size_t b) {
            const auto s = static_cast<Index>(a);
            const auto t = static_cast<Index>(b);
            if (degenerate_[s] == 0 && degenerate_[t] == 0 && intersecting(s, t)) {
                pairs.push_back({s, t});
            }
            return pairs.size() < most_intersections;
        });
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [a, b] : pairs) {
            add(SurfaceFault::intersection, {a, b}, {});
        }
    }

    /// True if two triangles have more in common than corners or an edge.
    [[nodiscard]] bool intersecting(Index s, Index t) const {
        std::array<bool, 3> shared{};  // corners of s
        std::array<bool, 3> found{};   // corners of t
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (place_[facets_[s][i]] == place_[facets_[t][j]]) {
                    shared[i] = found[j] = true;
                }
            }
        }
        const Triangle a = corners(s);
        const Triangle b = corners(t);
        switch (std::count(shared.begin(), shared.end(), true)) {
            case 0: return intersect(a, b);
            case 1: {
                const auto i = static_cast<std::size_t>(std::find(shared.begin(), shared.end(), true) - shared.begin());
                const auto j = static_cast<std::size_t>(std::find(found.begin(), found.end(), true) - found.begin());
                return intersect(a[(i + 1) % 3], a[(i + 2) % 3], b) || intersect(b[(j + 1) % 3], b[(j + 2) % 3], a);
            }
            case 2: {
                const auto i =
                    static_cast<std::size_t>(std::find(shared.begin(), shared.end(), false) - shared.begin());
                const auto j = static_cast<std::size_t>(std::find(found.begin(), found.end(), false) - found.begin());
                const Vec3& p = a[(i + 1) % 3];
                const Vec3& q = a[(i + 2) % 3];
                return orientation(p, q, a[i], b[j]) == 0 && same_side(p, q, a[i], b[j]);
            }
            default: return false;  // reported as duplicates, or as coincident nodes
        }
    }

    void check_shells() {
        const TriangleTree tree(nodes_, boundary_);
        const Shells shells = find_shells(tree, boundary_);
        for (std::size_t s = 0; s < shells.first.size(); ++s) {
            const Vec3& x = nodes_[boundary_[shells.first[s]][0]];
            const int depth = tree.crossings(x, [&](std::size_t t) { return shells.of[t] != s; });
            if ((depth % 2 == 0) != (shells.outwards[s] != 0)) {
                add(SurfaceFault::inside_out, {shells.first[s]}, {});
            }
        }
    }

    [[nodiscard]] Triangle corners(Index t) const {
        const TriCorners& c = facets_[t];
        return {nodes_[c[0]], nodes_[c[1]], nodes_[c[2]]};
    }

    std::span<const Vec3> given_;
    std::span<const TriCorners> facets_;
    std::span<const TriCorners> boundary_;
    std::vector<Vec3> nodes_;  ///< in a frame, where nothing over- or underflows
    std::vector<Index> facet_at_;
    std::vector<char> degenerate_;
    std::vector<Index> place_;
    std::vector<FacetEdge> edges_;
    SurfaceReport report_;
};

}  // namespace

SurfaceReport check_facets(std::span<const Vec3> nodes, std::span<const TriCorners> facets, std::size_t boundary) {
    return Checker(nodes, facets, boundary).run();
}

}  // namespace pavior::detail

namespace pavior {

SurfaceReport check_surface(std::span<const Vec3> nodes, std::span<const TriCorners> triangles) {
    return detail::check_facets(nodes, triangles, triangles.size());
}

}  // namespace pavior
