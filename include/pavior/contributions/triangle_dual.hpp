#pragma once
/// \file
/// Local dual contributions in the plane (section 5.2 \cite roca2009): triangles in, quadrilateral blocks out.

#include <pavior/contributions/matching_rules.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

/// Nodes where the boundary has a corner, and inner edges that are cuts.
struct TriangleMarks {
    std::vector<Index> vertices;
    std::vector<std::array<Index, 2>> layers;
};

/// The edges of T triangles; edge k of a triangle is opposite its corner k.
struct TriangleTopology {
    std::vector<std::array<Index, 2>> edges;           ///< 2 nodes, ascending; edges ascending
    std::vector<std::array<Index, 3>> triangle_edges;  ///< T x 3
    std::vector<std::array<Index, 2>> edge_triangles;  ///< ascending; the second no_index on the boundary

    /// The edge between two nodes in any order, no_index if there is none. O(log n).
    [[nodiscard]] Index edge(Index a, Index b) const {
        const std::array<Index, 2> wanted{std::min(a, b), std::max(a, b)};
        const auto at = std::lower_bound(edges.begin(), edges.end(), wanted);
        return at != edges.end() && *at == wanted ? static_cast<Index>(at - edges.begin()) : no_index;
    }
};

/// The dual of a triangulated plane domain or surface, and the blocks read off it. A triangle has seven pieces (three
/// at corners, three along edges, one inside) and nine candidates between them: c(e; t) for each edge, between the
/// edge's piece and the inner one, and c(v; e; t) for each end of each edge, between the corner's piece and the edge's:
///
///               2            c(e; t): the sides of the small triangle; hard at layer edges (boundary and cuts)
///              / \           c(v; e; t): its prolongations; they follow by the matching rules
///             +   +
///            / \ / \ .
///           /   +   \ .
///          /   / \   \ .
///         +---+---+---+
///        /   /     \   \ .
///       0---+-------+---1
struct TriangleDual {
    TriangleTopology topology;
    std::vector<EntityClass> edge_class;  ///< free or layer
    std::vector<EntityClass> node_class;  ///< free, layer, or hexahedron: a node that needs a dual point
    /// Of each triangle: 0 1 2 of edge k; 3 + 2 k + s of edge k and its end corner (k + 1 + s) mod 3.
    std::vector<std::array<Contribution, 9>> contributions;
    std::vector<Index> triangle_region;
    std::vector<Index> edge_region;
    std::vector<Index> node_region;  ///< no_index at a node of no triangle
    Index regions = 0;
    std::vector<int> region_dimension;  ///< 2 from a face, 1 from a chain, 0 from a vertex; one a region
    /// Blocks over the regions: vertex, chain, face, chain; counter-clockwise.
    std::vector<QuadCorners> blocks;
    std::size_t irregular = 0;  ///< dual points whose regions do not form a quadrilateral
};

namespace detail {

template <triangle_mesh M>
[[nodiscard]] TriangleTopology triangle_topology(const M& mesh) {
    struct Use {
        std::array<Index, 2> nodes;
        Index triangle;
        std::uint32_t local;
    };
    std::vector<Use> uses;
    const std::size_t nodes = node_count(mesh);
    for (const Index t : IndexRange(triangle_count(mesh))) {
        const TriCorners c = triangle(mesh, t);
        if (c[0] >= nodes || c[1] >= nodes || c[2] >= nodes || c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
            throw InputError(ErrorCode::bad_index,
                             "triangle " + std::to_string(t) + " names an unknown node or one node twice", {t});
        }
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(c[(k + 1) % 3], c[(k + 2) % 3]);
            uses.push_back({{low, high}, t, k});
        }
    }
    std::sort(uses.begin(), uses.end(),
              [](const Use& a, const Use& b) { return std::tie(a.nodes, a.triangle) < std::tie(b.nodes, b.triangle); });
    TriangleTopology out;
    out.triangle_edges.resize(triangle_count(mesh));
    for (const Use& use : uses) {
        if (out.edges.empty() || out.edges.back() != use.nodes) {
            out.edges.push_back(use.nodes);
            out.edge_triangles.push_back({use.triangle, no_index});
        } else if (std::exchange(out.edge_triangles.back()[1], use.triangle) != no_index) {
            throw InputError(ErrorCode::non_manifold, "an edge has more than two triangles",
                             {use.nodes[0], use.nodes[1]});
        }
        out.triangle_edges[use.triangle][use.local] = static_cast<Index>(out.edges.size() - 1);
    }
    return out;
}

/// Algorithms 5.9 to 5.11, one dimension lower.
template <triangle_mesh M>
void classify_triangles(const M& mesh, const TriangleMarks& marks, TriangleDual& out) {
    const auto& edges = out.topology.edges;
    out.edge_class.assign(edges.size(), EntityClass::free);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        out.edge_class[e] = out.topology.edge_triangles[e][1] == no_index ? EntityClass::layer : EntityClass::free;
    }
    for (const auto& [a, b] : marks.layers) {
        const Index e = out.topology.edge(a, b);
        if (e == no_index) {
            throw InputError(ErrorCode::bad_index,
                             "no edge between the nodes " + std::to_string(a) + " and " + std::to_string(b), {a, b});
        }
        out.edge_class[e] = EntityClass::layer;
    }
    std::vector<std::size_t> layers(node_count(mesh), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const Index i : edges[e]) {
            layers[i] += out.edge_class[e] == EntityClass::layer ? 1U : 0U;
        }
    }
    for (const std::size_t n : layers) {
        out.node_class.push_back(n == 0 ? EntityClass::free : n < 3 ? EntityClass::layer : EntityClass::hexahedron);
    }
    for (const Index i : marks.vertices) {
        if (i >= layers.size()) {
            throw InputError(ErrorCode::bad_index, "vertex " + std::to_string(i) + " is no node", {i});
        }
        out.node_class[i] = EntityClass::hexahedron;
    }
}

/// The rules of matching_rules.hpp one dimension lower: edges take the part of faces, nodes that of edges.
template <triangle_mesh M>
void add_triangle_contributions(const M& mesh, TriangleDual& out) {
    for (const Index t : IndexRange(triangle_count(mesh))) {
        const TriCorners c = triangle(mesh, t);
        std::array<Contribution, 9> all{};
        for (std::size_t k = 0; k < 3; ++k) {
            all[k] = match_face(out.edge_class[out.topology.triangle_edges[t][k]]);
            for (std::size_t s = 0; s < 2; ++s) {
                const EntityClass node = out.node_class[c[(k + 1 + s) % 3]];
                all[3 + 2 * k + s] = match_edge(node == EntityClass::hexahedron ? EntityClass::stack : node, all[k]);
            }
        }
        out.contributions.push_back(all);
    }
}

template <triangle_mesh M>
void join_triangle_pieces(const M& mesh, TriangleDual& out) {
    const std::size_t triangles = triangle_count(mesh);
    const std::size_t edges = triangles + out.topology.edges.size();
    DisjointSets sets(edges + node_count(mesh));
    std::vector<char> used(sets.size(), 1);
    std::fill(used.begin() + static_cast<std::ptrdiff_t>(edges), used.end(), 0);
    for (const Index t : IndexRange(triangles)) {
        const TriCorners c = triangle(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto edge = static_cast<Index>(triangles + out.topology.triangle_edges[t][k]);
            used[edges + c[k]] = 1;
            if (out.contributions[t][k] == Contribution::none) {
                sets.unite(t, edge);
            }
            for (std::size_t s = 0; s < 2; ++s) {
                if (out.contributions[t][3 + 2 * k + s] == Contribution::none) {
                    sets.unite(edge, static_cast<Index>(edges + c[(k + 1 + s) % 3]));
                }
            }
        }
    }
    std::vector<Index> id;
    out.regions = number_sets(sets, id, [&](Index i) { return used[i] != 0; });
    out.region_dimension.assign(out.regions, 0);
    for (std::size_t i = id.size(); i-- > 0;) {
        if (id[i] != no_index) {
            out.region_dimension[id[i]] = i < triangles ? 2 : i < edges ? 1 : 0;
        }
    }
    const auto first = id.begin();
    out.triangle_region.assign(first, first + static_cast<std::ptrdiff_t>(triangles));
    out.edge_region.assign(first + static_cast<std::ptrdiff_t>(triangles), first + static_cast<std::ptrdiff_t>(edges));
    out.node_region.assign(first + static_cast<std::ptrdiff_t>(edges), id.end());
}

/// Goes round \p node from triangle t, clockwise to a hard side, then counter-clockwise to the other.
template <triangle_mesh M>
void read_dual_point(const M& mesh, Index t, Index node, std::vector<std::uint8_t>& seen, TriangleDual& out) {
    const auto corner = [&](Index at) {
        const TriCorners c = triangle(mesh, at);
        return c[0] == node ? std::size_t{0} : c[1] == node ? std::size_t{1} : std::size_t{2};
    };
    // The edge from the node to the next corner is edge k + 2, to the one before k + 1.
    const auto step = [&](std::size_t which) {
        const Index start = t;
        do {
            const std::size_t k = corner(t);
            seen[t] = static_cast<std::uint8_t>(seen[t] | 1U << k);
            const std::size_t side = (k + which) % 3;
            if (out.contributions[t][side] != Contribution::none) {
                return out.topology.triangle_edges[t][side];
            }
            const auto& both = out.topology.edge_triangles[out.topology.triangle_edges[t][side]];
            t = both[0] == t ? both[1] : both[0];
        } while (t != start);
        return no_index;
    };
    const Index first = step(2);
    const Index last = first == no_index ? no_index : step(1);
    const bool regular = first != no_index && out.edge_region[first] != out.edge_region[last];
    out.irregular += regular ? 0 : 1;
    if (regular) {
        out.blocks.push_back(
            {out.node_region[node], out.edge_region[first], out.triangle_region[t], out.edge_region[last]});
    }
}
}  // namespace detail

/// Boundary nodes whose interior angle, the sum of the angles of the triangles there, is below \p below or, from
/// \p above on, re-entrant; in degrees. Ascending. O(n log n).
template <triangle_mesh M>
[[nodiscard]] std::vector<Index> corner_nodes(const M& mesh, double below = 135.0, double above = 225.0) {
    const TriangleTopology topology = detail::triangle_topology(mesh);
    std::vector<double> angle(node_count(mesh), 0.0);
    for (const Index t : IndexRange(triangle_count(mesh))) {
        const TriCorners c = triangle(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 u = node(mesh, c[(k + 1) % 3]) - node(mesh, c[k]);
            const Vec3 v = node(mesh, c[(k + 2) % 3]) - node(mesh, c[k]);
            const double sine =
                Vec3(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x())
                    .norm();
            angle[c[k]] += std::atan2(sine, u.dot(v)) * 180.0 / std::numbers::pi;
        }
    }
    std::vector<char> boundary(angle.size(), 0);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
        for (const Index i : topology.edges[e]) {
            boundary[i] = topology.edge_triangles[e][1] == no_index ? 1 : boundary[i];
        }
    }
    std::vector<Index> corners;
    for (const Index i : IndexRange(angle.size())) {
        if (boundary[i] != 0 && (angle[i] < below || angle[i] >= above)) {
            corners.push_back(i);
        }
    }
    return corners;
}

/// The local dual contributions of \p mesh with these marks, their regions, and the blocks that they stand for. With
/// valid marks (every chain has two different ends, every face is a disc with three corners or more) the blocks are the
/// midpoint subdivision of the faces that the layers cut the domain into; irregular counts the corners that give no
/// block otherwise. O(n log n).
/// \throws InputError bad_index (triangle, cut or vertex that does not exist), non_manifold (edge of three triangles)
template <triangle_mesh M>
[[nodiscard]] TriangleDual triangle_dual(const M& mesh, const TriangleMarks& marks) {
    TriangleDual out;
    out.topology = detail::triangle_topology(mesh);
    detail::classify_triangles(mesh, marks, out);
    detail::add_triangle_contributions(mesh, out);
    detail::join_triangle_pieces(mesh, out);
    std::vector<std::uint8_t> seen(triangle_count(mesh), 0);
    for (const Index t : IndexRange(seen.size())) {
        const TriCorners c = triangle(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            if (out.node_class[c[k]] == EntityClass::hexahedron && (seen[t] >> k & 1) == 0) {
                detail::read_dual_point(mesh, t, c[k], seen, out);
            }
        }
    }
    return out;
}

/// The blocks as a mesh, to look at: nodes of vertices in their place, those of chains and faces at the centroids.
/// Node i is region i. O(n).
template <triangle_mesh M>
[[nodiscard]] QuadMesh block_quads(const M& mesh, const TriangleDual& dual) {
    std::vector<Vec3> sum(dual.regions, Vec3::Zero());
    std::vector<double> weight(dual.regions, 0.0);
    const auto add = [&](Index region, int dimension, double size, const Vec3& at) {
        if (region != no_index && dual.region_dimension[region] == dimension) {
            sum[region] += size * at;
            weight[region] += size;
        }
    };
    for (const Index t : IndexRange(triangle_count(mesh))) {
        const TriCorners c = triangle(mesh, t);
        const Vec3 u = node(mesh, c[1]) - node(mesh, c[0]);
        const Vec3 v = node(mesh, c[2]) - node(mesh, c[0]);
        const double area = std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v)));
        add(dual.triangle_region[t], 2, area, node(mesh, c[0]) + (u + v) / 3.0);
    }
    for (std::size_t e = 0; e < dual.topology.edges.size(); ++e) {
        const Vec3 a = node(mesh, dual.topology.edges[e][0]);
        const Vec3 b = node(mesh, dual.topology.edges[e][1]);
        add(dual.edge_region[e], 1, (b - a).norm(), 0.5 * (a + b));
    }
    for (const Index i : IndexRange(node_count(mesh))) {
        add(dual.node_region[i], 0, 1.0, node(mesh, i));
    }
    QuadMesh quads{std::move(sum), dual.blocks};
    for (std::size_t i = 0; i < weight.size(); ++i) {
        quads.nodes[i] /= weight[i] > 0.0 ? weight[i] : 1.0;
    }
    return quads;
}

}  // namespace pavior
