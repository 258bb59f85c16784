#pragma once
/// \file
/// Joins the mesh of solids to that of neighbours whose nodes it was made to keep.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/brep.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/near_nodes.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Ids of the nodes that are given on some entities, and the length of the shortest edge between them.
struct GivenIds {
    std::vector<Index> ids;  ///< ascending
    double shortest = std::numeric_limits<double>::infinity();
};

/// For each of \p own, the id (of \p given) of the node within \p distance of it, or no_index.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> ids_at(const std::vector<Vec3>& own, std::span<const Vec3> given,
                                                      const std::vector<Index>& ids, double distance);

/// The quads as sorted corner ids, ascending; a quad with a corner that is no_index comes last.
[[nodiscard]] PAVIOR_INLINE std::vector<QuadCorners> sorted_quads(std::vector<QuadCorners> quads);

/// Pairs of neighbouring nodes on the edges of quads, the smaller id first, ascending.
[[nodiscard]] PAVIOR_INLINE std::vector<std::pair<Index, Index>> quad_edges(std::span<const QuadCorners> quads);

/// Edges and vertices of the faces of some solids, ascending.
struct SolidEdges {
    std::vector<EdgeId> edges;
    std::vector<VertexId> vertices;
};

template <brep B>
[[nodiscard]] SolidEdges solid_edges(const B& b, std::span<const SolidId> solids) {
    SolidEdges result;
    for (const SolidId solid : solids) {
        for (const OrientedFace& f : b.solid_faces(solid)) {
            for (const EdgeLoop& loop : b.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    result.edges.push_back(use.edge);
                    const auto ends = b.edge_vertices(use.edge);
                    result.vertices.insert(result.vertices.end(), ends.begin(), ends.end());
                }
            }
        }
    }
    const auto once = [](auto& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    once(result.edges);
    once(result.vertices);
    return result;
}

/// Faces of the solids that are given, ascending.
template <brep B>
[[nodiscard]] std::vector<FaceId> given_faces(const B& b, std::span<const SolidId> solids, const BoundaryMesh& given) {
    std::vector<FaceId> result;
    for (const SolidId solid : solids) {
        for (const OrientedFace& f : b.solid_faces(solid)) {
            if (!given.faces[f.face.index()].empty()) {
                result.push_back(f.face);
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// What \p given holds of the vertices, edges and faces.
[[nodiscard]] PAVIOR_INLINE GivenIds given_ids(const BoundaryMesh& given, const SolidEdges& entities,
                                               std::span<const FaceId> faces);

}  // namespace detail

/// For each node of \p mesh, a mesh of \p solids: the id of the node of \p given (neighbour_boundary() of neighbours)
/// at its place, no_index for new ones. Nodes are the same within 1e-4 of the shortest edge on what is shared.
/// O(n log n).
/// \throws UnmeshableError not_sweepable naming a shared face or edge on which the two meshes differ
template <brep B>
[[nodiscard]] std::vector<Index> given_nodes(const B& b, std::span<const SolidId> solids, const SolidsMesh& mesh,
                                             const BoundaryMesh& given) {
    const detail::SolidEdges entities = detail::solid_edges(b, solids);
    const std::vector<FaceId> faces = detail::given_faces(b, solids, given);
    const detail::GivenIds shared = detail::given_ids(given, entities, faces);
    std::vector<Index> result = detail::ids_at(mesh.mesh.nodes, given.nodes, shared.ids, 1e-4 * shared.shortest);
    std::vector<QuadCorners> own = mesh.quads;
    for (QuadCorners& quad : own) {
        for (Index& corner : quad) {
            corner = result[corner];
        }
    }
    for (const FaceId f : faces) {
        const FaceMesh& face = given.faces[f.index()];
        std::vector<QuadCorners> theirs = face.quads, ours;
        for (QuadCorners& quad : theirs) {
            for (Index& corner : quad) {
                corner = face.nodes[corner];
            }
        }
        for (std::size_t q = 0; q < own.size(); ++q) {
            if (mesh.quad_face[q] == f) {
                ours.push_back(own[q]);
            }
        }
        if (detail::sorted_quads(std::move(theirs)) != detail::sorted_quads(std::move(ours))) {
            const int tag = b.tag(2, f.index());
            throw UnmeshableError(ErrorCode::not_sweepable,
                                  "face " + std::to_string(tag) + ": the meshes on its two sides differ", {tag});
        }
    }
    const std::vector<std::pair<Index, Index>> lines = detail::quad_edges(own);
    for (const EdgeId e : entities.edges) {
        const std::vector<Index>& nodes = given.edges[e.index()].nodes;
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            const std::pair line(std::min(nodes[i], nodes[i + 1]), std::max(nodes[i], nodes[i + 1]));
            if (!std::binary_search(lines.begin(), lines.end(), line)) {
                throw UnmeshableError(ErrorCode::not_sweepable, "edge " + std::to_string(b.tag(1, e.index())) +
                                                                    ": the meshes of the solids at it differ");
            }
        }
    }
    return result;
}

/// Appends \p other to \p mesh: its nodes with a number in \p same (given_nodes()) are those of \p mesh, the others
/// come behind, and quads of faces for which \p given holds any are left out. O(both).
PAVIOR_INLINE void join_solids(const SolidsMesh& other, std::span<const Index> same, const BoundaryMesh& given,
                               SolidsMesh& mesh);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/join_solids-inl.hpp>
#endif
