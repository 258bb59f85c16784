#pragma once
/// \file
/// Classes of the faces, edges and nodes of a reference mesh (Algorithms 5.9 to 5.11 \cite roca2009).

#include <pavior/core/parallel_for.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior {

/// What the dual must look like round a face, edge or node (section 5.5.2 \cite roca2009).
enum class EntityClass : std::uint8_t {
    free,        ///< no dual surface needed
    layer,       ///< a dual surface, no dual curve
    stack,       ///< a dual curve, no dual point; edges and nodes only
    hexahedron,  ///< a dual point; nodes only
};

/// One class a face, edge and node, in the numbering of the topology.
struct EntityClasses {
    std::vector<EntityClass> face;
    std::vector<EntityClass> edge;
    std::vector<EntityClass> node;

    friend bool operator==(const EntityClasses&, const EntityClasses&) = default;
};

namespace detail {

/// Algorithm 5.9: layer faces are those of the boundary and the list of cuts.
template <classified_tet_mesh M>
[[nodiscard]] std::vector<EntityClass> classify_faces(const M& mesh, const TetTopology& topology, Execution execution) {
    std::vector<EntityClass> classes(topology.faces.size());
    parallel_for(execution, classes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            classes[f] = topology.boundary(static_cast<Index>(f)) ? EntityClass::layer : EntityClass::free;
        }
    });
    std::size_t found = 0;
    for (const TriCorners& nodes : feature_access<M>::layers(mesh)) {
        if (++found % 1024 == 0) {
            check_stop(execution.stop);
        }
        const Index f = topology.face(nodes);
        if (f == no_index) {
            throw InputError(ErrorCode::bad_index,
                             "layer face on nodes " + std::to_string(nodes[0]) + ", " + std::to_string(nodes[1]) +
                                 ", " + std::to_string(nodes[2]) + " is no face of the mesh",
                             {nodes[0], nodes[1], nodes[2]});
        }
        classes[f] = EntityClass::layer;
    }
    return classes;
}

/// Algorithm 5.10.
template <classified_tet_mesh M>
[[nodiscard]] std::vector<EntityClass> classify_edges(const M& mesh, const TetTopology& topology,
                                                      const std::vector<EntityClass>& faces, Execution execution) {
    std::vector<std::uint8_t> layers(topology.edges.size(), 0);
    for (const Index f : stoppable(IndexRange(faces.size()), execution.stop)) {
        if (faces[f] == EntityClass::layer) {
            for (const Index e : topology.face_edges[f]) {
                layers[e] = static_cast<std::uint8_t>(std::min(3, layers[e] + 1));
            }
        }
    }
    std::vector<EntityClass> classes(topology.edges.size());
    parallel_for(execution, classes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            classes[e] = layers[e] == 0 ? EntityClass::free : layers[e] < 3 ? EntityClass::layer : EntityClass::stack;
        }
    });
    for (const FeatureEdge& edge : feature_access<M>::curves(mesh)) {
        const Index e = topology.edge(edge.nodes[0], edge.nodes[1]);
        if (e == no_index) {
            throw InputError(ErrorCode::bad_index,
                             "feature edge on nodes " + std::to_string(edge.nodes[0]) + " and " +
                                 std::to_string(edge.nodes[1]) + " is no edge of the mesh",
                             {edge.nodes[0], edge.nodes[1]});
        }
        classes[e] = edge.kind != CurveKind::smooth ? EntityClass::stack : classes[e];
    }
    return classes;
}

/// Algorithm 5.11.
template <classified_tet_mesh M>
[[nodiscard]] std::vector<EntityClass> classify_nodes(const M& mesh, const TetTopology& topology,
                                                      const std::vector<EntityClass>& edges, Execution execution) {
    std::vector<std::uint8_t> stacks(topology.node_count(), 0);
    std::vector<EntityClass> classes(stacks.size(), EntityClass::free);
    for (const Index e : stoppable(IndexRange(edges.size()), execution.stop)) {
        if (edges[e] == EntityClass::free) {
            continue;
        }
        for (const Index i : topology.edges[e]) {
            stacks[i] = static_cast<std::uint8_t>(std::min(3, stacks[i] + (edges[e] == EntityClass::stack ? 1 : 0)));
            classes[i] = stacks[i] == 0  ? EntityClass::layer
                         : stacks[i] < 3 ? EntityClass::stack
                                         : EntityClass::hexahedron;
        }
    }
    for (const TaggedNode& vertex : feature_access<M>::vertices(mesh)) {
        if (vertex.node >= classes.size()) {
            throw InputError(ErrorCode::bad_index,
                             "feature vertex " + std::to_string(vertex.node) + " is no node of the mesh",
                             {vertex.node});
        }
        classes[vertex.node] = EntityClass::hexahedron;
    }
    return classes;
}
}  // namespace detail

/// Classifies the faces, edges and nodes of \p mesh, whose topology is \p topology. Edges of kind smooth among the
/// curves count as no features. O(n), one pass over faces, edges and nodes each; 1 byte each.
/// \throws InputError bad_index: layer face, feature edge or vertex that the mesh does not have (its nodes)
template <classified_tet_mesh M>
[[nodiscard]] EntityClasses classify(const M& mesh, const TetTopology& topology, Execution execution = sequential) {
    EntityClasses classes;
    classes.face = detail::classify_faces(mesh, topology, execution);
    classes.edge = detail::classify_edges(mesh, topology, classes.face, execution);
    classes.node = detail::classify_nodes(mesh, topology, classes.edge, execution);
    return classes;
}

#ifdef PAVIOR_COMPILED
extern template TetTopology tet_topology<ReferenceMesh>(const ReferenceMesh&, Execution);
extern template EntityClasses classify<ReferenceMesh>(const ReferenceMesh&, const TetTopology&, Execution);
#endif

}  // namespace pavior
