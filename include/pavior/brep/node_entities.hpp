#pragma once
/// \file
/// For every node of a mesh of solids, the vertex, edge, face or solid of the CAD model that it lies on.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/detail/entity_incidences.hpp>
#include <pavior/brep/nearest_edge.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

/// The entity of least dimension that a node lies on, and where.
struct NodeEntity {
    int dimension = 3;      ///< 0 vertex, 1 edge, 2 face, 3 inside a solid
    std::int32_t id = -1;   ///< dense id in the brep, as VertexId, EdgeId, FaceId or SolidId; -1: of no cell
    Vec2 uv{Vec2::Zero()};  ///< (t, 0) on an edge, (u, v) on a face, zero on vertices and inside solids

    friend bool operator==(const NodeEntity&, const NodeEntity&) = default;
};

struct NodeEntities {
    std::vector<NodeEntity> of_node;  ///< one a node
    double distance = 0;              ///< largest from a node to the point of its entity; insides count as 0
    Index farthest = no_index;        ///< the first node at that distance; no_index without boundary nodes
};

struct NodeEntityOptions {
    /// How near a node must be to a vertex or a seam that the mesh alone does not show, in parts of the shortest edge
    /// of a quad at the node.
    double tolerance = 1e-4;
};

/// The point of \p entity at its parameters. The entity must be a vertex, an edge or a face. One evaluation.
template <brep B>
[[nodiscard]] Vec3 entity_point(const B& b, const NodeEntity& entity) {
    PAVIOR_ASSERT(entity.id >= 0 && entity.dimension < 3);
    switch (entity.dimension) {
        case 0: return b.vertex_point(VertexId{entity.id});
        case 1: return b.edge_point(EdgeId{entity.id}, entity.uv[0]);
        default: return b.face_point(FaceId{entity.id}, entity.uv);
    }
}

namespace detail {

/// \throws InputError
PAVIOR_INLINE void check_mesh_entities(std::span<const Vec3> nodes, std::span<const HexCorners> hexes,
                                       std::span<const SolidId> hex_solid, std::span<const QuadCorners> quads,
                                       std::span<const FaceId> quad_face, std::size_t solids, std::size_t faces,
                                       const NodeEntityOptions& options);

/// Places the nodes of quads: corners, edges, other vertices, seams, faces, in this order.
template <brep B>
class NodePlacer {
public:
    NodePlacer(const B& b, std::span<const Vec3> nodes, const QuadSkeleton& skeleton, double tolerance,
               std::vector<NodeEntity>& result)
        : b_(b),
          nodes_(nodes),
          skeleton_(skeleton),
          tolerance_(tolerance),
          result_(result),
          around_(incidences(b)),
          near_edge_(b),
          vertex_node_(b.vertex_count(), no_index) {
        for (const std::vector<FaceId>& set : skeleton.sets) {
            set_edges_.push_back(around_.edges_between(set));
        }
    }

    void place() {
        place_corners();
        place_on_edges();
        place_vertices();
        place_on_seams();
        place_on_faces();
    }

private:
    void put(Index node, VertexId v) {
        vertex_node_[v.index()] = node;
        result_[node] = {0, v.value, Vec2::Zero()};
    }
    [[nodiscard]] double near(Index node) const { return tolerance_ * skeleton_.shortest[node]; }

    /// Calls visit(node, its entries of node_faces, its entries of node_sets) for every node of a quad, ascending.
    template <class Visit>
    void for_each_node(Visit&& visit) const {
        const std::span<const std::pair<Index, FaceId>> faces = skeleton_.node_faces;
        const std::span<const std::pair<Index, Index>> sets = skeleton_.node_sets;
        for (std::size_t f = 0, s = 0; f < faces.size();) {
            const Index node = faces[f].first;
            const std::size_t first_face = f, first_set = s;
            for (; f < faces.size() && faces[f].first == node; ++f) {
            }
            for (; s < sets.size() && sets[s].first == node; ++s) {
            }
            visit(node, faces.subspan(first_face, f - first_face), sets.subspan(first_set, s - first_set));
        }
    }

    /// Nodes where lines between faces end or change faces; the nearest node gets the vertex.
    void place_corners() {
        std::vector<std::tuple<double, Index, VertexId>> claims;
        for_each_node([&](Index node, const auto& faces, const auto& sets) {
            const bool smooth = sets.size() == 2 && sets[0] == sets[1];
            if (smooth || (sets.empty() && faces.size() == 1)) {
                return;
            }
            std::vector<FaceId> all;
            for (const auto& [at, f] : faces) {
                all.push_back(f);
            }
            const auto claim = [&](std::span<const VertexId> vertices, double within) {
                std::tuple<double, Index, VertexId> best{within, no_index, VertexId{}};
                for (const VertexId v : vertices) {
                    best = std::min(best, {(b_.vertex_point(v) - nodes_[node]).norm(), node, v});
                }
                if (std::get<1>(best) != no_index) {
                    claims.push_back(best);
                }
                return std::get<1>(best) != no_index;
            };
            if (!claim(around_.vertices_between(all), std::numeric_limits<double>::infinity())) {
                for (const FaceId f : all) {  // faces between these were merged away
                    if (claim(around_.face_vertices[f.index()], 0.5 * skeleton_.shortest[node])) {
                        break;
                    }
                }
            }
        });
        std::sort(claims.begin(), claims.end());
        for (const auto& [distance, node, v] : claims) {
            if (vertex_node_[v.index()] == no_index) {
                put(node, v);
            }
        }
    }

    void place_on_edges() {
        for_each_node([&](Index node, const auto&, const auto& sets) {
            if (sets.empty() || result_[node].dimension == 0) {
                return;
            }
            std::vector<EdgeId> edges;
            for (std::size_t i = 0; i < sets.size(); ++i) {
                const std::vector<EdgeId>& some = set_edges_[sets[i].second];
                if (i == 0 || sets[i] != sets[i - 1]) {
                    edges.insert(edges.end(), some.begin(), some.end());
                }
            }
            const EdgePoint found = near_edge_.nearest(edges, nodes_[node]);
            if (found.edge.valid()) {
                result_[node] = {1, found.edge.value, {found.t, 0.0}};
            }
        });
    }

    /// Vertices where lines run straight on, from edge to edge or round a closed one, and poles.
    void place_vertices() {
        std::vector<std::vector<Index>> on_edge(b_.edge_count()), on_face(b_.face_count());
        for_each_node([&](Index node, const auto& faces, const auto&) {
            if (result_[node].dimension > 0) {
                const bool edge = result_[node].dimension == 1;
                (edge ? on_edge[static_cast<std::size_t>(result_[node].id)] : on_face[faces[0].second.index()])
                    .push_back(node);
            }
        });
        for (std::size_t i = 0; i < vertex_node_.size(); ++i) {
            const VertexId v{static_cast<std::int32_t>(i)};
            if (vertex_node_[i] != no_index) {
                continue;
            }
            const Vec3 x = b_.vertex_point(v);
            std::pair<double, Index> best{std::numeric_limits<double>::infinity(), no_index};
            const auto look = [&](std::span<const Index> some) {
                for (const Index node : some) {
                    if (result_[node].dimension > 0) {
                        best = std::min(best, {(nodes_[node] - x).norm(), node});
                    }
                }
            };
            for (const EdgeId e : around_.vertex_edges[i]) {
                look(on_edge[e.index()]);
            }
            for (const FaceId f : around_.pole(v) ? around_.vertex_faces[i] : std::vector<FaceId>{}) {
                look(on_face[f.index()]);
            }
            if (best.second != no_index && best.first <= near(best.second)) {
                put(best.second, v);
            }
        }
    }

    /// Nodes near a seam that a mesh edge joins to another one, or to the end of the seam.
    void place_on_seams() {
        std::vector<EdgePoint> seam(nodes_.size());
        bool any = false;
        for_each_node([&](Index node, const auto& faces, const auto&) {
            const std::vector<EdgeId>& seams = around_.face_seams[faces[0].second.index()];
            if (result_[node].dimension != 2 || seams.empty()) {
                return;
            }
            for (const EdgeId e : seams) {
                if (near_edge_.at_least(e, nodes_[node]) <= near(node)) {
                    const EdgePoint found = near_edge_.closest(e, nodes_[node]);
                    const bool nearer = found.distance <= near(node) && found.distance < seam[node].distance;
                    seam[node] = nearer ? found : seam[node];
                }
            }
            any = any || seam[node].edge.valid();
        });
        const auto on = [&](Index node, EdgeId e) {
            const std::array<VertexId, 2> ends = b_.edge_vertices(e);
            const bool end = result_[node].dimension == 0 &&
                             (result_[node].id == ends[0].value || result_[node].id == ends[1].value);
            return end || seam[node].edge == e;
        };
        if (!any) {
            return;
        }
        skeleton_.edges.for_each([&](Index low, Index high, const auto&) {
            for (const auto& [node, other] : {std::pair(low, high), {high, low}}) {
                if (seam[node].edge.valid() && on(other, seam[node].edge)) {
                    result_[node] = {1, seam[node].edge.value, {seam[node].t, 0.0}};
                }
            }
        });
    }

    void place_on_faces() {
        std::vector<std::vector<Vec2>> middle(b_.face_count());
        for_each_node([&](Index node, const auto& faces, const auto&) {
            if (result_[node].dimension != 2) {
                return;
            }
            const FaceId f = faces[0].second;
            if (middle[f.index()].empty()) {
                middle[f.index()] = {middle_parameters(b_, f, around_.face_seams[f.index()])};
            }
            const std::array<double, 2> period = b_.face_period(f);
            Vec2 uv = b_.closest_on_face(f, nodes_[node]);
            for (Eigen::Index k = 0; k < 2; ++k) {
                const double p = period[static_cast<std::size_t>(k)];
                uv[k] -= p > 0 ? p * std::floor((uv[k] - middle[f.index()][0][k]) / p + 0.5) : 0.0;
            }
            result_[node].uv = uv;
        });
    }

    const B& b_;
    std::span<const Vec3> nodes_;
    const QuadSkeleton& skeleton_;
    double tolerance_;
    std::vector<NodeEntity>& result_;
    Incidences around_;
    std::vector<std::vector<EdgeId>> set_edges_;
    NearestEdge<B> near_edge_;
    std::vector<Index> vertex_node_;
};

}  // namespace detail

/// The entity of every node of a mesh of solids of \p b, from the faces of its boundary quads.
///
/// Nodes whose quads all lie on one face are on this face; mesh edges between quads of different faces follow the edges
/// that these faces share, of several the nearest. Nodes where such lines end, branch or change their faces are at the
/// vertex of all these faces (the nearest); other vertices and poles get the nearest node within options.tolerance, if
/// any: a mesh need not have a node at the vertex of a full circle. Where faces have no edge or no vertex in common
/// (the mesh has merged a narrow face between them), the nearest of the edges of these faces counts. A vertex has at
/// most one node. Nodes of a face are on its seam if they are that near and joined along it by mesh edges.
/// Parameters are those of the closest point: t within edge_range(); u and v, where periodic, within half a period of
/// the middle of the face, so between the two sides of its seam if it has one.
/// \param hexes,hex_solid  a node in no quad is inside the solid of its first hexahedron; of several solids, if the
/// quads between them are missing
/// \param quads,quad_face  mesh of the faces, those between two solids once or twice
/// O(n log n) and O(n) evaluations of the model: one closest_on_face() and one face_point() a node of a face, about
/// ten a node of an edge. Deterministic; as thread-safe as the model.
/// \throws InputError size_mismatch, bad_index (of a node, face or solid; a quad that names a node twice), not_finite,
/// bad_option (tolerance)
template <brep B>
[[nodiscard]] NodeEntities node_entities(const B& b, std::span<const Vec3> nodes, std::span<const HexCorners> hexes,
                                         std::span<const SolidId> hex_solid, std::span<const QuadCorners> quads,
                                         std::span<const FaceId> quad_face, const NodeEntityOptions& options = {}) {
    detail::check_mesh_entities(nodes, hexes, hex_solid, quads, quad_face, b.solid_count(), b.face_count(), options);
    NodeEntities result;
    result.of_node.resize(nodes.size());
    for (std::size_t h = hexes.size(); h-- > 0;) {
        for (const Index i : hexes[h]) {
            result.of_node[i].id = hex_solid[h].value;
        }
    }
    const detail::QuadSkeleton skeleton = detail::quad_skeleton(nodes, quads, quad_face);
    for (std::size_t i = skeleton.node_faces.size(); i-- > 0;) {
        result.of_node[skeleton.node_faces[i].first] = {2, skeleton.node_faces[i].second.value, Vec2::Zero()};
    }
    detail::NodePlacer<B>(b, nodes, skeleton, options.tolerance, result.of_node).place();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (result.of_node[i].dimension < 3) {
            const double distance = (entity_point(b, result.of_node[i]) - nodes[i]).norm();
            if (result.farthest == no_index || distance > result.distance) {
                result.distance = distance;
                result.farthest = static_cast<Index>(i);
            }
        }
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/node_entities-inl.hpp>
#endif
