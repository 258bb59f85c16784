#pragma once
/// \file
/// The mesh of solids that are done, as their neighbours find it on the faces and edges that they share.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/face_distance.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/sweep/unwrap.hpp>

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

/// The mesh of one face as a graph of its nodes.
class FaceGraph {
public:
    FaceGraph(std::span<const Vec3> nodes, std::vector<QuadCorners> quads);

    [[nodiscard]] const std::vector<Index>& ids() const { return ids_; }
    [[nodiscard]] const std::vector<QuadCorners>& quads() const { return quads_; }
    /// Within this a node counts as being at a place.
    [[nodiscard]] double tolerance() const { return tolerance_; }

    [[nodiscard]] Index at(const Vec3& x) const;

    /// Pairs of \p id and the nodes joined to it by an edge of a quad.
    [[nodiscard]] std::span<const std::pair<Index, Index>> links(Index id) const {
        const auto first = std::lower_bound(links_.begin(), links_.end(), std::pair(id, Index{0}));
        const auto last = std::upper_bound(first, links_.end(), std::pair(id, no_index));
        return {first, last};
    }

private:
    template <class T>
    static void sort_once(std::vector<T>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    std::span<const Vec3> nodes_;
    std::vector<QuadCorners> quads_;
    std::vector<Index> ids_;
    std::vector<std::pair<Index, Index>> links_;
    double tolerance_ = 0.0;
};

/// Follows \p e over the edges of quads from one end to the other; empty nodes if they do not lie along it.
template <brep B>
[[nodiscard]] EdgeNodes find_edge(const B& b, std::span<const Vec3> nodes, const FaceGraph& graph, EdgeId e,
                                  Index first, Index last) {
    const std::array<double, 2> range = b.edge_range(e);
    EdgeNodes result{{first}, {range[0]}};
    while (result.nodes.size() == 1 || result.nodes.back() != last) {
        Index next = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [from, to] : graph.links(result.nodes.back())) {
            const double t = to == last ? range[1] : closest_on_edge(b, e, nodes[to]);
            const bool on_edge = to == last || (b.edge_point(e, t) - nodes[to]).norm() <= graph.tolerance();
            if (on_edge && t > result.parameters.back() && t < nearest) {
                nearest = t;
                next = to;
            }
        }
        if (next == no_index) {
            return {};
        }
        result.nodes.push_back(next);
        result.parameters.push_back(nearest);
    }
    return result;
}

/// Parameters of the nodes of a face, continuous from neighbour to neighbour.
template <brep B>
[[nodiscard]] std::vector<Vec2> graph_parameters(const B& b, std::span<const Vec3> nodes, const FaceGraph& graph,
                                                 FaceId f) {
    const std::vector<Index>& ids = graph.ids();
    std::vector<Vec2> uv;
    for (const Index id : ids) {
        uv.push_back(b.closest_on_face(f, nodes[id]));
    }
    const Periods periods = b.face_period(f);
    const auto position = [&](Index id) {
        return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    };
    std::vector<bool> seen(ids.size(), false);
    std::vector<std::size_t> queue{0};
    seen[0] = true;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        for (const auto& [from, to] : graph.links(ids[queue[i]])) {
            const std::size_t at = position(to);
            if (!seen[at]) {
                seen[at] = true;
                uv[at] += nearest_image_shift(uv[at], uv[queue[i]], periods);
                queue.push_back(at);
            }
        }
    }
    return uv;
}

}  // namespace detail

/// Reads a mesh of some faces back: nodes of their vertices and edges, quads with parameters. \p quads (ids in
/// \p nodes) lie on the faces \p quad_face, counter-clockwise about the face's own normal; only those on \p faces
/// count. \p nodes become the nodes of the result, with the same ids. Faces come back unstructured, see
/// structure_side(). A node belongs to a vertex or an edge if it lies within a thousandth of the shortest edge of a
/// quad. O(n log n) and about 40 evaluations of the model for each node at an edge.
/// \throws UnmeshableError not_sweepable naming a face if a vertex is no node or an edge no line of edges of quads;
/// InputError size_mismatch
template <brep B>
[[nodiscard]] BoundaryMesh neighbour_boundary(const B& b, std::vector<Vec3> nodes, std::span<const QuadCorners> quads,
                                              std::span<const FaceId> quad_face, std::span<const FaceId> faces) {
    detail::check_quad_faces(quads, quad_face);
    BoundaryMesh mesh;
    mesh.nodes = std::move(nodes);
    mesh.vertices.assign(b.vertex_count(), no_index);
    mesh.edges.resize(b.edge_count());
    mesh.faces.resize(b.face_count());
    std::vector<std::vector<QuadCorners>> quads_of(b.face_count());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        quads_of[quad_face[q].index()].push_back(quads[q]);
    }
    for (const FaceId f : faces) {
        const int tag = b.tag(2, f.index());
        const auto fail = [&](const std::string& what) {
            return UnmeshableError(ErrorCode::not_sweepable,
                                   "face " + std::to_string(tag) + ": the mesh of the solid on its other side " + what,
                                   {tag});
        };
        if (quads_of[f.index()].empty()) {
            throw fail("has no quads on it");
        }
        const detail::FaceGraph graph(mesh.nodes, std::move(quads_of[f.index()]));
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                EdgeNodes& edge = mesh.edges[use.edge.index()];
                std::array<Index, 2> ends{};
                for (std::size_t i = 0; i < 2; ++i) {
                    const VertexId v = b.edge_vertices(use.edge)[i];
                    Index& vertex = mesh.vertices[v.index()];
                    vertex = vertex == no_index ? graph.at(b.vertex_point(v)) : vertex;
                    ends[i] = vertex;
                    if (vertex == no_index) {
                        throw fail("has no node at vertex " + std::to_string(b.tag(0, v.index())));
                    }
                }
                if (edge.nodes.empty()) {
                    edge = detail::find_edge(b, mesh.nodes, graph, use.edge, ends[0], ends[1]);
                }
                if (edge.nodes.empty()) {
                    throw fail("does not follow edge " + std::to_string(b.tag(1, use.edge.index())));
                }
            }
        }
        FaceMesh& face = mesh.faces[f.index()];
        face.nodes = graph.ids();
        face.uv = detail::graph_parameters(b, mesh.nodes, graph, f);
        face.quads = graph.quads();
        for (QuadCorners& quad : face.quads) {
            for (Index& corner : quad) {
                corner = static_cast<Index>(std::lower_bound(face.nodes.begin(), face.nodes.end(), corner) -
                                            face.nodes.begin());
            }
        }
    }
    return mesh;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/neighbour_boundary-inl.hpp>
#endif
