#pragma once

#include <pavior/dual/features.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE CurveKind curve_kind(double degrees, const FeatureOptions& options) {
    constexpr double noise = 1e-6;
    return degrees < options.end_below - noise        ? CurveKind::end
           : degrees < options.corner_above - noise   ? CurveKind::smooth
           : degrees < options.reversal_above - noise ? CurveKind::corner
                                                      : CurveKind::reversal;
}

namespace detail {

PAVIOR_INLINE void check_options(const FeatureOptions& options) {
    if (!(options.end_below > 0.0 && options.end_below <= 180.0 && options.corner_above >= 180.0 &&
          options.corner_above <= options.reversal_above)) {
        throw InputError(ErrorCode::bad_option,
                         "feature angles need 0 < end_below <= 180 <= corner_above <= reversal_above, not " +
                             std::to_string(options.end_below) + ", " + std::to_string(options.corner_above) + ", " +
                             std::to_string(options.reversal_above));
    }
}

PAVIOR_INLINE void check_magnitude(const std::vector<double>& lengths) {
    const double longest = lengths.empty() ? 1.0 : *std::max_element(lengths.begin(), lengths.end());
    if (!(longest <= 1e75 && longest >= 1e-75)) {
        std::ostringstream text;
        text << "the longest edge of the boundary is " << longest << ": scale the solid into 1e-75 to 1e75";
        throw InputError(ErrorCode::overflow, text.str());
    }
}

PAVIOR_INLINE void fill_patches(const BoundarySurface& surface, const std::vector<CurveKind>& kinds,
                                const TetTopology& topology, const std::vector<TaggedTriangle>& tagged,
                                ReferenceMesh& out) {
    DisjointSets sets(surface.triangles.size());
    for (std::size_t s = 0; s < kinds.size(); ++s) {
        if (kinds[s] == CurveKind::smooth) {
            sets.unite(surface.edge_triangles[s][0], surface.edge_triangles[s][1]);
        }
    }
    std::vector<Index> id;
    number_sets(sets, id, [](Index) { return true; });
    for (const Index b : IndexRange(id.size())) {
        out.patches.push_back({surface.triangles[b], static_cast<std::int32_t>(id[b])});
    }
    for (const TaggedTriangle& triangle : tagged) {
        const Index f = topology.face(triangle.nodes);
        const auto at = std::lower_bound(surface.faces.begin(), surface.faces.end(), f);
        if (f != no_index && at != surface.faces.end() && *at == f) {
            const auto b = static_cast<std::size_t>(at - surface.faces.begin());
            out.patch_tags.push_back({out.patches[b].tag, triangle.tag});
        }
    }
}

PAVIOR_INLINE void fill_curves(const FeatureFinder<FeatureOptions>& finder, const BoundarySurface& surface,
                               const std::vector<CurveKind>& kinds, const TetTopology& topology,
                               const std::vector<TaggedEdge>& tagged, ReferenceMesh& out) {
    DisjointSets<> sets = finder.curves();
    std::vector<Index> id;
    number_sets(sets, id, [&](Index s) { return kinds[s] != CurveKind::smooth; });
    for (const Index s : IndexRange(id.size())) {
        if (id[s] != no_index) {
            out.curves.push_back({topology.edges[surface.edges[s]], static_cast<std::int32_t>(id[s]), kinds[s]});
        }
    }
    for (const TaggedEdge& edge : tagged) {
        const Index e = topology.edge(edge.nodes[0], edge.nodes[1]);
        const auto at = std::lower_bound(surface.edges.begin(), surface.edges.end(), e);
        if (at != surface.edges.end() && *at == e) {
            const Index curve = id[static_cast<std::size_t>(at - surface.edges.begin())];
            if (curve != no_index) {
                out.curve_tags.push_back({static_cast<std::int32_t>(curve), edge.tag});
            }
        }
    }
}

PAVIOR_INLINE void fill_vertices(const FeatureFinder<FeatureOptions>& finder, const std::vector<TaggedNode>& tagged,
                                 ReferenceMesh& out) {
    const std::vector<Index> valence = finder.valences();
    std::vector<std::int32_t> tag(valence.size(), -1);
    for (const TaggedNode& vertex : tagged) {
        tag[vertex.node] = vertex.tag;
    }
    for (const Index i : IndexRange(valence.size())) {
        if (valence[i] == 1 || valence[i] >= 3 || finder.forced_vertices()[i] != 0) {
            out.vertices.push_back({i, tag[i]});
        }
    }
}

PAVIOR_INLINE void fill_layers(const TetTopology& topology, const std::vector<TaggedTriangle>& facets,
                               ReferenceMesh& out) {
    for (const TaggedTriangle& facet : facets) {
        const Index f = topology.face(facet.nodes);
        if (f == no_index) {
            throw InputError(ErrorCode::bad_index,
                             "the tetrahedra have no face on the tagged nodes " + std::to_string(facet.nodes[0]) +
                                 ", " + std::to_string(facet.nodes[1]) + ", " + std::to_string(facet.nodes[2]),
                             {facet.nodes[0], facet.nodes[1], facet.nodes[2]});
        }
        if (!topology.boundary(f)) {
            out.layers.push_back(topology.faces[f]);
        }
    }
}

}  // namespace detail

PAVIOR_INLINE ReferenceMesh make_reference_mesh(const TaggedTetMesh& tets, const FeatureOptions& options) {
    TetMesh copy = detail::copy_tets(tets.mesh, options.sort_tets);
    ReferenceMesh out =
        detail::find_features(copy, tet_topology(copy), tets.triangles, tets.edges, tets.vertices, options);
    out.nodes = std::move(copy.nodes);
    out.tets = std::move(copy.tets);
    return out;
}

PAVIOR_INLINE std::vector<Index> feature_valences(const ReferenceMesh& mesh) {
    std::vector<Index> at_node(mesh.nodes.size(), 0);
    for (const FeatureEdge& edge : mesh.curves) {
        for (const Index i : edge.nodes) {
            at_node[i] += edge.kind != CurveKind::smooth ? 1 : 0;
        }
    }
    std::vector<Index> result;
    result.reserve(mesh.vertices.size());
    for (const TaggedNode& vertex : mesh.vertices) {
        result.push_back(at_node[vertex.node]);
    }
    return result;
}

}  // namespace pavior
