#pragma once
/// \file
/// Nodes of a mesh moved onto the vertices, edges and faces of its model.

#include <pavior/brep/node_entities.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/entity_guide.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace pavior {

/// How settle_nodes() works. Lengths are in the unit of the model.
struct SettleOptions {
    double size = 0;             ///< wished length of mesh edges; above 0
    double near_feature = 0.75;  ///< nodes go to a vertex or a feature edge from so far away, in sizes
    double near = 0.1;           ///< and so far to a face
    Execution execution = sequential;
};

struct SettledNodes {
    /// As node_entities() says, but nodes that are left off their entity are held_node().
    std::vector<NodeEntity> of_node;
    std::size_t held = 0;      ///< how many
    double min_jacobian = -1;  ///< least scaled Jacobian, with the nodes where they are now
};

/// Moves the nodes of a mesh that is nearly on its model onto it: nodes where the mesh turns from one edge into another
/// to the vertex between, the other nodes of these edges so that they keep their spacing, nodes of edges and faces to
/// the points next to them. Where faces meet smoothly (EdgeAngle::smooth()), nodes that are not at the edge between
/// them belong to the nearest of these faces. A mesh that names smooth faces wrongly, or has been made on triangles,
/// keeps the feature edges of its model so.
///
/// Inner nodes follow (improve_hexes()) where a hexahedron gets nearly flat, then those on faces and edges, sliding.
/// If that does not help, nodes of such hexahedra stay where they were, until no hexahedron is worse than nearly flat
/// that was not before. O(n) and some evaluations of the model a boundary node; the same bytes for any number of
/// threads.
/// \throws InputError bad_option, size_mismatch, bad_index; Stopped; what the model throws
PAVIOR_INLINE SettledNodes settle_nodes(const AnyModel& b, SolidsMesh& mesh, const SettleOptions& options);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/settle_nodes-inl.hpp>
#endif
