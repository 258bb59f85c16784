#include "problem.hpp"

#include <pavior/core/disjoint_sets.hpp>

#include "facet_edges.hpp"

#include <Eigen/Geometry>

#include <map>
#include <utility>

namespace pavior::detail {

namespace {

using NodePair = std::array<Index, 2>;

NodePair ascending(const NodePair& nodes) { return {std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])}; }

Vec3 facet_normal(const Plc& plc, const TriCorners& c) {
    return (plc.nodes[c[1]] - plc.nodes[c[0]]).cross(plc.nodes[c[2]] - plc.nodes[c[0]]);
}

/// Tagged edges by their nodes.
std::map<NodePair, int> numbers_of_edges(const Plc& plc) {
    std::map<NodePair, int> numbers;
    for (const TaggedEdge& edge : plc.edges) {
        numbers.emplace(ascending(edge.nodes), edge.tag);
    }
    return numbers;
}

/// Parallel but for rounding: an angle of 1e-9.
bool parallel(const Vec3& a, const Vec3& b) {
    return a.dot(b) > 0.0 && a.cross(b).norm() <= 1e-9 * a.norm() * b.norm();
}

}  // namespace

Problem make_problem(const TaggedSurface& surface, std::span<const TaggedTriangle> inner) {
    Problem problem;
    problem.surface = &surface;
    Plc& plc = problem.plc;
    plc.frame = frame_of(surface.mesh.nodes);
    for (const Vec3& x : surface.mesh.nodes) {
        plc.nodes.push_back(plc.frame.inside(x));
    }
    const auto add = [&](const TriCorners& corners, std::int32_t tag, bool is_inner) {
        plc.facets.push_back(corners);
        plc.facet_numbers.push_back(first_number + static_cast<int>(problem.sources.size()));
        problem.sources.push_back({facet_normal(plc, corners), tag, is_inner});
    };
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        add(surface.mesh.triangles[t], surface.face_tags.empty() ? 0 : surface.face_tags[t], false);
    }
    for (const TaggedTriangle& triangle : inner) {
        add(triangle.nodes, triangle.tag, true);
    }
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
        plc.edges.push_back({surface.edges[e].nodes, first_number + static_cast<int>(e)});
    }
    plc.holes = cavity_points(plc.nodes, surface.mesh.triangles);
    return problem;
}

Problem merge_coplanar(const Problem& problem) {
    Problem merged = problem;
    merged.keep_surface = false;
    const Plc& plc = problem.plc;
    const auto tagged = numbers_of_edges(plc);
    const std::vector<FacetEdge> edges = facet_edges(plc.facets);
    DisjointSets sets(plc.facets.size());
    for_each_edge(edges, [&](std::span<const FacetEdge> uses) {
        if (uses.size() != 2 || uses[0].forward == uses[1].forward || tagged.contains({uses[0].low, uses[0].high})) {
            return;
        }
        const FacetSource& a = problem.sources[uses[0].facet];
        const FacetSource& b = problem.sources[uses[1].facet];
        if (a.tag == b.tag && a.inner == b.inner && parallel(a.normal, b.normal)) {
            sets.unite(uses[0].facet, uses[1].facet);
        }
    });
    // A tagged edge inside a set would be lost: such a set stays as it is.
    std::vector<char> cut(plc.facets.size(), 0);
    for_each_edge(edges, [&](std::span<const FacetEdge> uses) {
        for (std::size_t i = 1; i < uses.size() && tagged.contains({uses[0].low, uses[0].high}); ++i) {
            const Index set = sets.root(uses[i].facet);
            cut[set] = static_cast<char>(cut[set] | static_cast<char>(set == sets.root(uses[0].facet)));
        }
    });
    for (std::size_t f = 0; f < plc.facets.size(); ++f) {
        const Index set = sets.root(static_cast<Index>(f));
        merged.plc.facet_numbers[f] = plc.facet_numbers[cut[set] != 0 ? f : set];
    }
    return merged;
}

namespace {

/// One pass over all edges: halves those that are the longest of all their facets and longer than \p length.
/// Returns false if there was none.
bool halve_longest(Problem& problem, std::map<NodePair, int>& tagged, double length) {
    Plc& plc = problem.plc;
    const std::vector<FacetEdge> edges = facet_edges(plc.facets);
    const auto longer = [&](const NodePair& a, const NodePair& b) {  // ties by node numbers, so that one always wins
        const double p = (plc.nodes[a[0]] - plc.nodes[a[1]]).squaredNorm();
        const double q = (plc.nodes[b[0]] - plc.nodes[b[1]]).squaredNorm();
        return p != q ? p > q : ascending(a) < ascending(b);
    };
    const auto edge_of = [&](Index facet, int k) {
        const TriCorners& c = plc.facets[facet];
        return NodePair{c[static_cast<std::size_t>(k)], c[static_cast<std::size_t>((k + 1) % 3)]};
    };
    std::vector<std::pair<std::span<const FacetEdge>, Index>> chosen;
    for_each_edge(edges, [&](std::span<const FacetEdge> uses) {
        const NodePair edge{uses[0].low, uses[0].high};
        bool longest = (plc.nodes[edge[0]] - plc.nodes[edge[1]]).norm() > length;
        for (const FacetEdge& use : uses) {
            longest = longest && !longer(edge_of(use.facet, (use.edge + 1) % 3), edge) &&
                      !longer(edge_of(use.facet, (use.edge + 2) % 3), edge);
        }
        if (longest) {
            chosen.emplace_back(uses, static_cast<Index>(plc.nodes.size()));
            plc.nodes.push_back((plc.nodes[edge[0]] + plc.nodes[edge[1]]) / 2.0);
        }
    });
    for (const auto& [uses, middle] : chosen) {
        for (const FacetEdge& use : uses) {
            const auto k = static_cast<std::size_t>(use.edge);
            TriCorners& near = plc.facets[use.facet];
            TriCorners far = near;
            near[(k + 1) % 3] = middle;
            far[k] = middle;
            const int number = plc.facet_numbers[use.facet];
            plc.facets.push_back(far);
            plc.facet_numbers.push_back(number);
        }
        if (const auto at = tagged.find({uses[0].low, uses[0].high}); at != tagged.end()) {
            const int number = at->second;
            tagged.erase(at);
            tagged.emplace(NodePair{uses[0].low, middle}, number);
            tagged.emplace(NodePair{uses[0].high, middle}, number);
        }
    }
    return !chosen.empty();
}

}  // namespace

Problem split_edges(const Problem& problem, double length) {
    Problem split = problem;
    split.keep_surface = false;
    auto tagged = numbers_of_edges(split.plc);
    while (halve_longest(split, tagged, length)) {
    }
    split.plc.edges.clear();
    for (const auto& [nodes, number] : tagged) {
        split.plc.edges.push_back({nodes, number});
    }
    return split;
}

}  // namespace pavior::detail
