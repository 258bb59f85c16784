#pragma once
// What must hold for the entities of the nodes of any mesh whose boundary nodes lie on the model.
#include <pavior/brep/node_entities.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace pavior::test {

/// The entities of a mesh with the members mesh, hex_solid, quads and quad_face.
template <brep B, class Mesh>
NodeEntities entities_of(const B& b, const Mesh& mesh, const NodeEntityOptions& options = {}) {
    return node_entities(b, mesh.mesh.nodes, mesh.mesh.hexes, mesh.hex_solid, mesh.quads, mesh.quad_face, options);
}

/// How many nodes have an entity of each dimension.
inline std::array<int, 4> dimensions(const NodeEntities& entities) {
    std::array<int, 4> count{};
    for (const NodeEntity& entity : entities.of_node) {
        ++count[static_cast<std::size_t>(entity.dimension)];
    }
    return count;
}

template <brep B>
double edge_distance(const B& b, EdgeId e, const Vec3& x) {
    return (b.edge_point(e, closest_on_edge(b, e, x)) - x).norm();
}

/// Dimension 0, 1 or 2 of the least entity of the faces of a node within \p within, by looking at all of them.
template <brep B>
int least_dimension(const B& b, const std::set<FaceId>& faces, const Vec3& x, double within) {
    double vertex = std::numeric_limits<double>::infinity();
    double edge = vertex;
    for (const FaceId f : faces) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                for (const VertexId v : b.edge_vertices(use.edge)) {
                    vertex = std::min(vertex, (b.vertex_point(v) - x).norm());
                }
                edge = std::min(edge, edge_distance(b, use.edge, x));
            }
        }
    }
    return vertex <= within ? 0 : edge <= within ? 1 : 2;
}

/// Each node is where its entity says, to \p within; the entity is the least one there, and belongs to all its faces.
template <brep B, class Mesh>
void check_places(const B& b, const Mesh& mesh, const NodeEntities& entities, double within) {
    const std::vector<Vec3>& nodes = mesh.mesh.nodes;
    REQUIRE(entities.of_node.size() == nodes.size());
    std::vector<std::set<FaceId>> faces(nodes.size());
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (const Index i : mesh.quads[q]) {
            faces[i].insert(mesh.quad_face[q]);
        }
    }
    std::vector<std::set<SolidId>> solids(nodes.size());
    for (std::size_t h = 0; h < mesh.mesh.hexes.size(); ++h) {
        for (const Index i : mesh.mesh.hexes[h]) {
            solids[i].insert(mesh.hex_solid[h]);
        }
    }
    double largest = 0;
    int wrong = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeEntity& entity = entities.of_node[i];
        if (faces[i].empty()) {
            wrong += entity.dimension != 3 || solids[i] != std::set{SolidId{entity.id}} || entity.uv != Vec2::Zero();
            continue;
        }
        REQUIRE(entity.dimension < 3);
        largest = std::max(largest, (entity_point(b, entity) - nodes[i]).norm());
        wrong += entity.dimension != least_dimension(b, faces[i], nodes[i], within);
        for (const FaceId f : faces[i]) {
            bool bounds = entity.dimension == 2 && entity.id == f.value;
            for (const EdgeLoop& loop : b.face_loops(f)) {
                for (const OrientedEdge& use : loop) {
                    const auto ends = b.edge_vertices(use.edge);
                    bounds = bounds || (entity.dimension == 1 && entity.id == use.edge.value) ||
                             (entity.dimension == 0 && (entity.id == ends[0].value || entity.id == ends[1].value));
                }
            }
            wrong += !bounds;
        }
    }
    CHECK(wrong == 0);
    CHECK(largest <= within);
    CHECK(entities.distance == largest);
    if (entities.farthest != no_index) {
        const Index far = entities.farthest;
        CHECK((entity_point(b, entities.of_node[far]) - nodes[far]).norm() == largest);
    }
}

/// Every vertex that bounds \p faces has one node; those of each edge follow each other along mesh edges as t grows.
template <brep B, class Mesh>
void check_lines(const B& b, const Mesh& mesh, const NodeEntities& entities, const std::set<FaceId>& faces) {
    std::set<std::pair<Index, Index>> joined;
    for (const QuadCorners& q : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            joined.insert(std::minmax(q[k], q[(k + 1) % 4]));
        }
    }
    std::map<std::int32_t, std::vector<Index>> on_vertex;
    std::map<std::int32_t, std::vector<std::pair<double, Index>>> on_edge;
    for (Index i = 0; i < entities.of_node.size(); ++i) {
        const NodeEntity& entity = entities.of_node[i];
        if (entity.dimension == 0) {
            on_vertex[entity.id].push_back(i);
        } else if (entity.dimension == 1) {
            on_edge[entity.id].emplace_back(entity.uv[0], i);
        }
    }
    std::set<EdgeId> edges;
    for (const FaceId f : faces) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                edges.insert(use.edge);
            }
        }
    }
    int wrong = 0;
    for (const EdgeId e : edges) {
        const auto ends = b.edge_vertices(e);
        const auto range = b.edge_range(e);
        REQUIRE(on_vertex[ends[0].value].size() == 1);
        REQUIRE(on_vertex[ends[1].value].size() == 1);
        if (ends[0] == ends[1] && b.edge_length(e) < 1e-9) {
            continue;
        }
        std::vector<std::pair<double, Index>>& line = on_edge[e.value];
        std::sort(line.begin(), line.end());
        wrong += !line.empty() && !(line.front().first > range[0] && line.back().first < range[1]);
        line.emplace(line.begin(), range[0], on_vertex[ends[0].value][0]);
        line.emplace_back(range[1], on_vertex[ends[1].value][0]);
        for (std::size_t i = 1; i < line.size(); ++i) {
            wrong += !(line[i - 1].first < line[i].first);
            wrong += joined.count(std::minmax(line[i - 1].second, line[i].second)) != 1;
        }
    }
    CHECK(wrong == 0);
}

/// Both, for a mesh of all that its quads name.
template <brep B, class Mesh>
NodeEntities checked_entities(const B& b, const Mesh& mesh, double within) {
    const NodeEntities entities = entities_of(b, mesh);
    check_places(b, mesh, entities, within);
    check_lines(b, mesh, entities, {mesh.quad_face.begin(), mesh.quad_face.end()});
    return entities;
}

}  // namespace pavior::test
