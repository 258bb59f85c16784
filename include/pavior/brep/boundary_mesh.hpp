#pragma once
/// \file
/// The mesh of the vertices, edges and faces of a CAD model. Entities own their nodes, so that solids which share a
/// face, an edge or a vertex share its nodes: conformity is by construction.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/edge_mesh.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

namespace pavior {

/// Nodes of one edge, in the sense of its parameter; both ends included. Empty if not meshed.
struct EdgeNodes {
    std::vector<Index> nodes;        ///< ids in BoundaryMesh::nodes
    std::vector<double> parameters;  ///< one a node
};

/// Mesh of one face. Empty if not meshed.
struct FaceMesh {
    std::vector<Index> nodes;  ///< ids in BoundaryMesh::nodes; a closed structured face names its seam's nodes twice
    std::vector<Vec2> uv;      ///< parameters of the nodes on the face
    std::vector<QuadCorners> quads;  ///< positions in `nodes`, counter-clockwise about the face's own normal
    int columns = 0;                 ///< intervals of a structured face: node (i, k) is nodes[k * (columns + 1) + i];
    int rows = 0;                    ///< 0 for an unstructured one

    [[nodiscard]] bool empty() const { return quads.empty(); }
    [[nodiscard]] bool structured() const { return columns > 0; }
};

/// Nodes and cells of the boundary of a model, in arrays by entity id.
struct BoundaryMesh {
    std::vector<Vec3> nodes;
    std::vector<Index> vertices;  ///< node of each vertex, no_index if not meshed
    std::vector<EdgeNodes> edges;
    std::vector<FaceMesh> faces;

    [[nodiscard]] Index add_node(const Vec3& x) {
        nodes.push_back(x);
        return static_cast<Index>(nodes.size() - 1);
    }
};

/// Meshes every edge whose entry of \p intervals (by edge id) is positive. Nodes lie at equal arc length, or where
/// \p parameters (by edge id) holds any for the edge, at these: ascending over its range, one more than the intervals.
/// Adds to \p mesh, what is meshed there stays.
template <brep B>
[[nodiscard]] BoundaryMesh mesh_edges(const B& b, std::span<const int> intervals,
                                      std::span<const std::vector<double>> parameters = {}, BoundaryMesh mesh = {}) {
    mesh.vertices.resize(b.vertex_count(), no_index);
    mesh.edges.resize(b.edge_count());
    mesh.faces.resize(b.face_count());
    const auto vertex = [&](VertexId v) {
        Index& at = mesh.vertices[v.index()];
        if (at == no_index) {
            at = mesh.add_node(b.vertex_point(v));
        }
        return at;
    };
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        EdgeNodes& edge = mesh.edges[i];
        if (intervals[i] <= 0 || !edge.nodes.empty()) {
            continue;
        }
        const EdgeId e{static_cast<std::int32_t>(i)};
        const bool given = !parameters.empty() && !parameters[i].empty();
        edge.parameters = given ? parameters[i] : edge_parameters(b, e, equal_fractions(intervals[i]));
        const auto ends = b.edge_vertices(e);
        edge.nodes.push_back(vertex(ends[0]));
        for (std::size_t k = 1; k + 1 < edge.parameters.size(); ++k) {
            edge.nodes.push_back(mesh.add_node(b.edge_point(e, edge.parameters[k])));
        }
        edge.nodes.push_back(vertex(ends[1]));
    }
    return mesh;
}

/// Nodes of a chain of edges with their parameters on \p face.
struct ChainNodes {
    std::vector<Index> nodes;  ///< one more than the intervals of the chain
    std::vector<Vec2> uv;      ///< as the model gives them: they may jump by periods of the face
};

/// Reads the nodes of \p chain as the boundary of \p face. \p along: whether the chain runs along the face's loop as
/// the face itself sees it (true) or against it (false); it decides the side of a seam.
template <brep B>
[[nodiscard]] ChainNodes chain_nodes(const B& b, const BoundaryMesh& mesh, std::span<const OrientedEdge> chain,
                                     FaceId face, bool along) {
    ChainNodes result;
    for (const OrientedEdge& use : chain) {
        const EdgeNodes& edge = mesh.edges[use.edge.index()];
        PAVIOR_ASSERT(!edge.nodes.empty());
        const std::size_t n = edge.nodes.size();
        for (std::size_t i = result.nodes.empty() ? 0 : 1; i < n; ++i) {
            const std::size_t k = use.forward ? i : n - 1 - i;
            result.nodes.push_back(edge.nodes[k]);
            result.uv.push_back(b.edge_on_face(use.edge, edge.parameters[k], face, use.forward == along));
        }
    }
    return result;
}

namespace detail {

/// Quads seen from the other side.
[[nodiscard]] PAVIOR_INLINE std::vector<QuadCorners> flipped(std::vector<QuadCorners> quads);

/// Ids to positions in a list of ids.
class PositionOf {
public:
    explicit PositionOf(std::span<const Index> ids);
    [[nodiscard]] Index operator()(Index id) const {
        const auto found = positions_.find(id);
        return found == positions_.end() ? no_index : found->second;
    }

private:
    std::unordered_map<Index, Index> positions_;
};

/// Numbers nodes in the order in which they are first used, after the first \p kept ones, which keep their numbers.
class Renumbering {
public:
    Renumbering(const BoundaryMesh& mesh, std::vector<Vec3>& nodes, std::size_t kept = 0) : mesh_(mesh), nodes_(nodes) {
        nodes_.assign(mesh.nodes.begin(), mesh.nodes.begin() + static_cast<std::ptrdiff_t>(kept));
        number_.assign(mesh.nodes.size(), no_index);
        std::iota(number_.begin(), number_.begin() + static_cast<std::ptrdiff_t>(kept), Index{0});
    }
    Index operator()(Index id) {
        if (number_[id] == no_index) {
            number_[id] = static_cast<Index>(nodes_.size());
            nodes_.push_back(mesh_.nodes[id]);
        }
        return number_[id];
    }

private:
    const BoundaryMesh& mesh_;
    std::vector<Vec3>& nodes_;
    std::vector<Index> number_;
};

/// Appends the meshes of the faces, but for those for which left_out(face) is true, to the quads of a SolidsMesh.
template <class LeftOut>
void append_faces(SolidsMesh& result, const BoundaryMesh& mesh, Renumbering& number, LeftOut&& left_out) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const FaceId id{static_cast<std::int32_t>(f)};
        if (left_out(id)) {
            continue;
        }
        const std::vector<Index>& ids = mesh.faces[f].nodes;
        for (const QuadCorners& q : mesh.faces[f].quads) {
            result.quads.push_back({number(ids[q[0]]), number(ids[q[1]]), number(ids[q[2]]), number(ids[q[3]])});
            result.quad_face.push_back(id);
        }
    }
}

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/boundary_mesh-inl.hpp>
#endif
