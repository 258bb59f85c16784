#pragma once
/// \file
/// Feature curves and vertices of a tetrahedral mesh (section 5.4.1 \cite roca2009), and with them the reference mesh.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/detail/feature_finder.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/spatial_order.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
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
[[nodiscard]] PAVIOR_INLINE CurveKind curve_kind(double degrees, const FeatureOptions& options = {});

namespace detail {

PAVIOR_INLINE void check_options(const FeatureOptions& options);

/// Refuses solids for which products of four lengths leave the range of doubles.
PAVIOR_INLINE void check_magnitude(const std::vector<double>& lengths);

/// Fills patches: components of the boundary triangles cut by the feature edges, in the order of their first faces.
PAVIOR_INLINE void fill_patches(const BoundarySurface& surface, const std::vector<CurveKind>& kinds,
                                const TetTopology& topology, const std::vector<TaggedTriangle>& tagged,
                                ReferenceMesh& out);

PAVIOR_INLINE void fill_curves(const FeatureFinder<FeatureOptions>& finder, const BoundarySurface& surface,
                               const std::vector<CurveKind>& kinds, const TetTopology& topology,
                               const std::vector<TaggedEdge>& tagged, ReferenceMesh& out);

PAVIOR_INLINE void fill_vertices(const FeatureFinder<FeatureOptions>& finder, const std::vector<TaggedNode>& tagged,
                                 ReferenceMesh& out);

PAVIOR_INLINE void fill_layers(const TetTopology& topology, const std::vector<TaggedTriangle>& facets,
                               ReferenceMesh& out);

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
[[nodiscard]] PAVIOR_INLINE ReferenceMesh make_reference_mesh(const TaggedTetMesh& tets,
                                                              const FeatureOptions& options = {});

/// Number of feature edges at each of mesh.vertices: its valence. O(n).
[[nodiscard]] PAVIOR_INLINE std::vector<Index> feature_valences(const ReferenceMesh& mesh);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/dual/features-inl.hpp>
#endif
