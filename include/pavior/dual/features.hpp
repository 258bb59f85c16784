#pragma once
/// \file
/// Feature curves and vertices of a tetrahedral mesh (section 5.4.1 \cite roca2009), and with them the reference mesh.

#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/detail/feature_finder.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/spatial_order.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

/// What the user knows better about one curve.
struct CurveOverride {
    /// Two nodes of an edge of the curve; the default means that `tag` names it.
    std::array<Index, 2> nodes{no_index, no_index};
    std::int32_t tag = 0;  ///< of the geometry's curve: all edges that carry it
    CurveKind kind = CurveKind::smooth;
};

/// Which edges may be feature edges when the mesh comes with tagged edges.
enum class TaggedEdges : std::uint8_t {
    candidates,  ///< the tagged ones, where the angle says so
    ignored,     ///< all, where the angle says so
    features,    ///< the tagged ones, whatever the angle: `end` where it says smooth
};

/// How make_reference_mesh() finds the features. Angles are interior dihedral angles in degrees; what is less than a
/// millionth below a limit counts as on it, since angles of exactly 135 degrees are common and carry round-off.
struct FeatureOptions {
    double end_below = 135.0;       ///< below: end
    double corner_above = 225.0;    ///< above, or equal: corner
    double reversal_above = 315.0;  ///< above, or equal: reversal
    /// Only heeded if there are tagged edges; without any, the angle decides everywhere.
    TaggedEdges tagged_edges = TaggedEdges::candidates;
    /// Tagged nodes are feature vertices however many feature curves meet there. Otherwise they only lend their tag,
    /// since a node between two curves (the seam of a cylinder) admits no hexahedral corner.
    bool force_tagged_vertices = false;
    /// Tetrahedra are brought into spatial_order(), which makes all later steps faster; false: they keep their order.
    bool sort_tets = true;
    /// Inner facets of the tetrahedra become layer faces (cuts).
    bool facets_are_layers = true;
    /// Applied in their order to the curves found. Kind smooth removes the feature; another kind adds one if need be.
    std::vector<CurveOverride> overrides;
};

/// The kind of a curve at this interior dihedral angle in degrees.
[[nodiscard]] inline CurveKind curve_kind(double degrees, const FeatureOptions& options = {}) {
    constexpr double noise = 1e-6;
    return degrees < options.end_below - noise        ? CurveKind::end
           : degrees < options.corner_above - noise   ? CurveKind::smooth
           : degrees < options.reversal_above - noise ? CurveKind::corner
                                                      : CurveKind::reversal;
}

namespace detail {

inline void check_options(const FeatureOptions& options) {
    if (!(options.end_below > 0.0 && options.end_below <= 180.0 && options.corner_above >= 180.0 &&
          options.corner_above <= options.reversal_above)) {
        throw InputError(ErrorCode::bad_option,
                         "feature angles need 0 < end_below <= 180 <= corner_above <= reversal_above, not " +
                             std::to_string(options.end_below) + ", " + std::to_string(options.corner_above) + ", " +
                             std::to_string(options.reversal_above));
    }
}

/// Refuses solids for which products of four lengths leave the range of doubles.
inline void check_magnitude(const std::vector<double>& lengths) {
    const double longest = lengths.empty() ? 1.0 : *std::max_element(lengths.begin(), lengths.end());
    if (!(longest <= 1e75 && longest >= 1e-75)) {
        std::ostringstream text;
        text << "the longest edge of the boundary is " << longest << ": scale the solid into 1e-75 to 1e75";
        throw InputError(ErrorCode::overflow, text.str());
    }
}

/// Fills patches: components of the boundary triangles cut by the feature edges, in the order of their first faces.
inline void fill_patches(const BoundarySurface& surface, const std::vector<CurveKind>& kinds,
                         const TetTopology& topology, const std::vector<TaggedTriangle>& tagged, ReferenceMesh& out) {
    IndexSets sets(surface.triangles.size());
    for (std::size_t s = 0; s < kinds.size(); ++s) {
        if (kinds[s] == CurveKind::smooth) {
            sets.unite(surface.edge_triangles[s][0], surface.edge_triangles[s][1]);
        }
    }
    std::vector<Index> id;
    std::ignore = number_sets(sets, id, [](Index) { return true; });
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

inline void fill_curves(const FeatureFinder<FeatureOptions>& finder, const BoundarySurface& surface,
                        const std::vector<CurveKind>& kinds, const TetTopology& topology,
                        const std::vector<TaggedEdge>& tagged, ReferenceMesh& out) {
    IndexSets sets = finder.curves();
    std::vector<Index> id;
    std::ignore = number_sets(sets, id, [&](Index s) { return kinds[s] != CurveKind::smooth; });
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

inline void fill_vertices(const FeatureFinder<FeatureOptions>& finder, const std::vector<TaggedNode>& tagged,
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

inline void fill_layers(const TetTopology& topology, const std::vector<TaggedTriangle>& facets, ReferenceMesh& out) {
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

template <class Tag>
void sort_unique(std::vector<Tag>& tags) {
    std::sort(tags.begin(), tags.end());
    tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
}

template <tet_mesh M>
[[nodiscard]] TetMesh copy_tets(const M& mesh, bool sorted) {
    TetMesh out;
    out.nodes.reserve(node_count(mesh));
    for (const Index i : IndexRange(node_count(mesh))) {
        out.nodes.push_back(node(mesh, i));
    }
    const std::vector<Index> order = sorted ? spatial_order(mesh) : std::vector<Index>{};
    out.tets.reserve(tet_count(mesh));
    for (const Index t : IndexRange(tet_count(mesh))) {
        out.tets.push_back(tet(mesh, sorted ? order[t] : t));
    }
    return out;
}

template <tet_mesh M>
[[nodiscard]] ReferenceMesh find_features(const M& mesh, const TetTopology& topology,
                                          const std::vector<TaggedTriangle>& triangles,
                                          const std::vector<TaggedEdge>& edges, const std::vector<TaggedNode>& vertices,
                                          const FeatureOptions& options) {
    check_options(options);
    for (const TaggedNode& vertex : vertices) {
        if (vertex.node >= node_count(mesh)) {
            throw InputError(ErrorCode::bad_index, "tagged node " + std::to_string(vertex.node) + " does not exist",
                             {vertex.node});
        }
    }
    const BoundarySurface surface = boundary_surface(mesh, topology);
    std::vector<double> lengths;
    lengths.reserve(surface.edges.size());
    std::transform(surface.edges.begin(), surface.edges.end(), std::back_inserter(lengths), [&](Index e) {
        return (node(mesh, topology.edges[e][1]) - node(mesh, topology.edges[e][0])).stableNorm();
    });
    check_magnitude(lengths);
    FeatureFinder<FeatureOptions> finder(topology, surface, interior_angles(mesh, topology, surface),
                                         std::move(lengths), options);
    finder.find(edges, vertices);
    ReferenceMesh out;
    fill_patches(surface, finder.kinds(), topology, triangles, out);
    fill_curves(finder, surface, finder.kinds(), topology, edges, out);
    fill_vertices(finder, vertices, out);
    if (options.facets_are_layers) {
        fill_layers(topology, triangles, out);
    }
    sort_unique(out.patch_tags);
    sort_unique(out.curve_tags);
    sort_unique(out.layers);
    return out;
}
}  // namespace detail

/// The reference mesh of \p mesh: same nodes, its tetrahedra in spatial order, and
/// - patches: the boundary triangles in the order of their faces in the topology; tag = patch, a component of the
///   boundary cut by the feature edges, 0, 1, 2 ...;
/// - curves: the feature edges in the order of their edges in the topology; curve = a maximal chain between feature
///   vertices or a closed loop, 0, 1, 2 ... A curve has one kind, that of its mean angle, unless the angle takes it
///   from convex to re-entrant. A node of two feature edges is no vertex, however sharp the kink;
/// - vertices: nodes of one feature edge (where a curve ends inside a patch) or of three and more, ascending.
/// O(n). \throws InputError bad_option (limits; an override that names no boundary edge), non_manifold (boundary that
/// touches itself), overflow (a longest boundary edge below 1e-75 or above 1e75), what tet_topology() throws
template <tet_mesh M>
[[nodiscard]] ReferenceMesh make_reference_mesh(const M& mesh, const FeatureOptions& options = {}) {
    TetMesh tets = detail::copy_tets(mesh, options.sort_tets);
    ReferenceMesh out = detail::find_features(tets, tet_topology(tets), {}, {}, {}, options);
    out.nodes = std::move(tets.nodes);
    out.tets = std::move(tets.tets);
    return out;
}

/// The same where the topology of \p mesh is known. Tetrahedra keep their order: \p topology is that of the result too.
template <tet_mesh M>
[[nodiscard]] ReferenceMesh make_reference_mesh(const M& mesh, const TetTopology& topology,
                                                const FeatureOptions& options = {}) {
    ReferenceMesh out = detail::find_features(mesh, topology, {}, {}, {}, options);
    TetMesh tets = detail::copy_tets(mesh, false);
    out.nodes = std::move(tets.nodes);
    out.tets = std::move(tets.tets);
    return out;
}

/// The same for tetrahedra with tags: patches and curves also carry tags (patch_tags, curve_tags), vertices theirs,
/// inner facets become layers, and tagged edges are heeded as options.tagged_edges says.
/// \throws also bad_index (tagged edge, triangle or node that the tetrahedra do not have)
[[nodiscard]] inline ReferenceMesh make_reference_mesh(const TaggedTetMesh& tets, const FeatureOptions& options = {}) {
    TetMesh copy = detail::copy_tets(tets.mesh, options.sort_tets);
    ReferenceMesh out =
        detail::find_features(copy, tet_topology(copy), tets.triangles, tets.edges, tets.vertices, options);
    out.nodes = std::move(copy.nodes);
    out.tets = std::move(copy.tets);
    return out;
}

/// Number of feature edges at each of mesh.vertices: its valence. O(n).
[[nodiscard]] inline std::vector<Index> feature_valences(const ReferenceMesh& mesh) {
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
