#include "shells.hpp"

#include <pavior/core/disjoint_sets.hpp>

#include "facet_edges.hpp"
#include "predicates.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pavior::detail {

namespace {

std::vector<Box<Vec3>> boxes_of(std::span<const Vec3> nodes, std::span<const TriCorners> triangles) {
    std::vector<Box<Vec3>> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const Index node : triangles[t]) {
            boxes[t].add(nodes[node]);
        }
    }
    return boxes;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vec3> nodes, std::span<const TriCorners> triangles)
    : nodes_(nodes), triangles_(triangles), boxes_(boxes_of(nodes, triangles)), all_(bounds(nodes)) {}

Vec3 TriangleTree::centre(std::size_t t) const {
    const TriCorners& c = triangles_[t];
    return (nodes_[c[0]] + nodes_[c[1]] + nodes_[c[2]]) / 3.0;
}

Vec3 TriangleTree::unit_normal(std::size_t t) const {
    const TriCorners& c = triangles_[t];
    return (nodes_[c[1]] - nodes_[c[0]]).cross(nodes_[c[2]] - nodes_[c[0]]).stableNormalized();
}

Vec3 TriangleTree::far_point(int attempt) const {
    // Directions that no sensible model uses, a new one each time.
    const double turn = 0.7345 + 2.399963 * attempt;
    const double height = std::cos(1.0 + 1.7 * attempt);
    const double width = std::sqrt(1.0 - height * height);
    const Vec3 direction(width * std::cos(turn), width * std::sin(turn), height);
    return all_.centre() + 3.0 * all_.diagonal() * direction;
}

int TriangleTree::side_of(std::size_t t, const Vec3& q) const {
    const TriCorners& c = triangles_[t];
    return orientation(nodes_[c[0]], nodes_[c[1]], nodes_[c[2]], q);
}

std::optional<int> TriangleTree::crosses(const Vec3& p, const Vec3& q, std::size_t t) const {
    const TriCorners& c = triangles_[t];
    const Vec3& x = nodes_[c[0]];
    const Vec3& y = nodes_[c[1]];
    const Vec3& z = nodes_[c[2]];
    const int from = side_of(t, p);
    const int to = side_of(t, q);
    if (to == 0) {
        return std::nullopt;
    }
    if (from == 0 || from == to) {
        return 0;
    }
    const std::array<int, 3> sides{orientation(p, q, x, y), orientation(p, q, y, z), orientation(p, q, z, x)};
    const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
    if (*low < 0 && *high > 0) {
        return 0;
    }
    return *low == 0 || *high == 0 ? std::nullopt : std::optional(1);
}

double TriangleTree::clearance(std::size_t t) const {
    const Vec3 from = centre(t);
    const Vec3 d = unit_normal(t);
    double nearest = std::numeric_limits<double>::infinity();
    boxes_.for_each_on_segment(from, from + 2.0 * all_.diagonal() * d, [&](std::size_t other) {
        if (other == t) {
            return;
        }
        const TriCorners& c = triangles_[other];
        const Vec3 u = nodes_[c[1]] - nodes_[c[0]];
        const Vec3 v = nodes_[c[2]] - nodes_[c[0]];
        const Vec3 h = d.cross(v);
        const double det = u.dot(h);
        if (det == 0.0) {
            return;
        }
        const Vec3 s = from - nodes_[c[0]];
        const double a = s.dot(h) / det;
        const double b = d.dot(s.cross(u)) / det;
        const double along = v.dot(s.cross(u)) / det;
        if (a >= -1e-9 && b >= -1e-9 && a + b <= 1.0 + 1e-9 && along > 0.0) {
            nearest = std::min(nearest, along);
        }
    });
    return nearest;
}

Shells find_shells(const TriangleTree& tree, std::span<const TriCorners> triangles) {
    DisjointSets sets(triangles.size());
    const std::vector<FacetEdge> edges = facet_edges(triangles);
    for_each_edge(edges, [&](std::span<const FacetEdge> uses) {
        for (const FacetEdge& use : uses) {
            sets.unite(uses[0].facet, use.facet);
        }
    });
    Shells shells;
    shells.of.resize(triangles.size());
    for (Index t = 0; t < triangles.size(); ++t) {
        const Index root = sets.root(t);
        if (root == t) {
            shells.of[t] = static_cast<Index>(shells.first.size());
            shells.first.push_back(t);
        }
        shells.of[t] = shells.of[root];
    }
    for (std::size_t s = 0; s < shells.first.size(); ++s) {
        const int sign = tree.outwards(shells.first[s], [&](std::size_t t) { return shells.of[t] == s; });
        shells.outwards.push_back(static_cast<char>(sign > 0));
    }
    return shells;
}

}  // namespace pavior::detail
