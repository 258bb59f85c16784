#pragma once

#include <pavior/marking/detail/facet_corners.hpp>
#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/fronts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Tags of the boundary triangles, which the mesh lists in any order and rotation.
[[nodiscard]] inline std::vector<std::int32_t> tags_of(const ReferenceMesh& mesh, const BoundarySurface& surface,
                                                       const TetTopology& topology) {
    std::vector<Index> place(topology.faces.size(), no_index);
    for (const Index b : IndexRange(surface.faces.size())) {
        place[surface.faces[b]] = b;
    }
    std::vector<std::int32_t> tags(surface.faces.size(), 0);
    for (const TaggedTriangle& patch : mesh.patches) {
        const Index face = topology.face(patch.nodes);
        if (face != no_index && place[face] != no_index) {
            tags[place[face]] = patch.tag;
        }
    }
    return tags;
}

}  // namespace detail

PAVIOR_INLINE FrontBoundary front_boundary(const ReferenceMesh& mesh, const TetTopology& topology) {
    FrontBoundary out;
    out.surface = boundary_surface(mesh, topology);
    out.tags = detail::tags_of(mesh, out.surface, topology);
    for (const TriCorners& c : out.surface.triangles) {
        out.facets.push_back(detail::make_facet(mesh.nodes[c[0]], mesh.nodes[c[1]], mesh.nodes[c[2]]));
    }
    std::vector<Index> place(topology.edges.size(), no_index);
    for (const Index s : IndexRange(out.surface.edges.size())) {
        place[out.surface.edges[s]] = s;
    }
    out.feature.assign(out.surface.edges.size(), 0);
    for (const FeatureEdge& edge : mesh.curves) {
        const Index e = topology.edge(edge.nodes[0], edge.nodes[1]);
        if (e != no_index && place[e] != no_index) {
            out.feature[place[e]] = 1;
        }
    }
    out.on_surface =
        detail::facet_corners(out.surface.triangles, mesh.nodes.size(), [&](Index t) { return out.facets[t].normal; });
    for (const TaggedNode& v : mesh.vertices) {
        out.on_surface[v.node] = 1;
    }
    return out;
}

namespace detail {

/// The nodes of a set of edges that form one path or loop, in order, from the end with the smaller id (a loop: from
/// its smallest node towards the smaller neighbour).
[[nodiscard]] inline std::vector<Index> order_chain(std::vector<std::array<Index, 2>> edges) {
    std::vector<std::array<Index, 2>> half;
    for (const auto& [a, b] : edges) {
        half.push_back({a, b});
        half.push_back({b, a});
    }
    std::sort(half.begin(), half.end());
    const auto from = [&](Index a) { return std::lower_bound(half.begin(), half.end(), std::array<Index, 2>{a, 0}); };
    Index start = half.front()[0];
    for (const auto& h : half) {
        const auto at = from(h[0]);
        if (at + 1 == half.end() || (*(at + 1))[0] != h[0]) {
            start = h[0];
            break;
        }
    }
    std::vector<Index> nodes{start, (*from(start))[1]};
    while (nodes.size() <= edges.size()) {
        auto at = from(nodes.back());
        if (at != half.end() && (*at)[1] == nodes[nodes.size() - 2]) {
            ++at;
        }
        if (at == half.end() || (*at)[0] != nodes.back()) {
            break;
        }
        nodes.push_back((*at)[1]);
    }
    return nodes;
}

PAVIOR_INLINE FrontFinder::FrontFinder(const ReferenceMesh& mesh, const TetTopology& topology,
                                       const FrontBoundary& boundary, double tolerance)
    : mesh_(mesh), topology_(topology), boundary_(boundary), tolerance_(tolerance) {
    place_.assign(topology.edges.size(), no_index);
    for (const Index s : IndexRange(boundary.surface.edges.size())) {
        place_[boundary.surface.edges[s]] = s;
    }
}

PAVIOR_INLINE std::vector<Front> FrontFinder::find() {
    std::vector<FeatureEdge> edges;
    for (const FeatureEdge& e : mesh_.curves) {
        if (e.kind == CurveKind::corner || e.kind == CurveKind::reversal) {
            edges.push_back(e);
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const FeatureEdge& a, const FeatureEdge& b) { return a.curve < b.curve; });
    std::vector<Front> fronts;
    for (std::size_t i = 0; i < edges.size();) {
        std::vector<std::array<Index, 2>> chain;
        const FeatureEdge first = edges[i];
        for (; i < edges.size() && edges[i].curve == first.curve; ++i) {
            chain.push_back(edges[i].nodes);
        }
        add_fronts(first, order_chain(std::move(chain)), fronts);
    }
    return fronts;
}

PAVIOR_INLINE Index FrontFinder::triangle_along(Index a, Index b) const {
    const Index s = place_[topology_.edge(a, b)];
    for (const Index t : boundary_.surface.edge_triangles[s]) {
        const TriCorners& c = boundary_.surface.triangles[t];
        if ((c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b)) {
            return t;
        }
    }
    return boundary_.surface.edge_triangles[s][0];
}

PAVIOR_INLINE void FrontFinder::add_fronts(const FeatureEdge& curve, const std::vector<Index>& chain,
                                           std::vector<Front>& fronts) {
    for (const bool left : {true, false}) {
        Front front;
        front.curve = curve.curve;
        front.kind = curve.kind;
        front.chain = chain;
        std::vector<Index> along;
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
            const Index a = chain[k];
            const Index b = chain[k + 1];
            along.push_back(left ? triangle_along(a, b) : triangle_along(b, a));
            const Vec3 tangent = mesh_.nodes[b] - mesh_.nodes[a];
            const Vec3 out = tangent.cross(boundary_.facets[along.back()].normal).stableNormalized();
            front.ahead.push_back(left ? out : Vec3(-out));
        }
        front.patch = boundary_.tags[along.front()];
        fit(along, front);
        fronts.push_back(std::move(front));
    }
}

PAVIOR_INLINE PatchSurface FrontFinder::fit_region(const std::vector<Index>& region) const {
    std::vector<Facet> facets;
    std::vector<Index> nodes;
    for (const Index t : region) {
        facets.push_back(boundary_.facets[t]);
        const TriCorners& c = boundary_.surface.triangles[t];
        nodes.insert(nodes.end(), c.begin(), c.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<Vec3> points;
    std::vector<Vec3> all;
    for (const Index i : nodes) {
        all.push_back(mesh_.nodes[i]);
        if (boundary_.on_surface[i] != 0) {
            points.push_back(mesh_.nodes[i]);
        }
    }
    const PatchSurface flat = fit_surface(facets, all, tolerance_);
    if (flat.kind == SurfaceKind::plane || points.size() < 4) {
        return flat;
    }
    PatchSurface s = fit_surface(facets, points, 10 * tolerance_);
    for (const Vec3& x : all) {
        s.sagitta = std::max(s.sagitta, std::abs(s.distance(x)));
    }
    return s;
}

PAVIOR_INLINE void FrontFinder::fit(const std::vector<Index>& along, Front& front) const {
    const auto anywhere = [](Index) { return true; };
    front.region = grow(along, anywhere);
    front.surface = fit_region(front.region);
    if (front.surface.kind != SurfaceKind::facets) {
        return;
    }
    const PatchSurface strip = fit_region(along);
    if (strip.kind != SurfaceKind::facets && strip.kind != SurfaceKind::plane) {
        grow_onto(along, strip, front);
    } else if (strip.kind == SurfaceKind::plane) {
        grow_onto(along, strip, front);
    }
}

PAVIOR_INLINE void FrontFinder::grow_onto(const std::vector<Index>& along, const PatchSurface& strip,
                                          Front& front) const {
    const double band = tolerance_ + 1.5 * strip.sagitta;
    const auto near = [&](Index t) {
        for (const Index i : boundary_.surface.triangles[t]) {
            if (std::abs(strip.distance(mesh_.nodes[i])) > band) {
                return false;
            }
        }
        return true;
    };
    front.region = grow(along, near);
    const PatchSurface fitted = fit_region(front.region);
    front.surface = fitted.kind == SurfaceKind::facets ? strip : fitted;
}

}  // namespace detail

}  // namespace pavior
