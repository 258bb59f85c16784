#pragma once
// What must hold for a mesh of a CAD model that keeps its features.
#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/part/part_mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pavior::test {

/// Every edge of the model between different faces is a chain of mesh edges whose nodes lie on it, every vertex a node.
inline void check_features(const GmshBrep& model, const PartMesh& part, double size) {
    CHECK(part.entities.distance < 1e-6 * size);
    std::set<std::pair<Index, Index>> joined;
    for (const QuadCorners& quad : part.data.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            joined.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
        }
    }
    std::map<std::int32_t, Index> vertex;
    std::map<std::int32_t, std::vector<std::pair<double, Index>>> on_edge;
    for (Index i = 0; i < part.entities.of_node.size(); ++i) {
        const NodeEntity& on = part.entities.of_node[i];
        if (on.dimension == 0) {
            vertex[on.id] = i;
        } else if (on.dimension == 1) {
            on_edge[on.id].emplace_back(on.uv[0], i);
        }
    }
    std::map<EdgeId, std::set<FaceId>> faces;
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        for (const EdgeLoop& loop : model.face_loops(FaceId{static_cast<std::int32_t>(f)})) {
            for (const OrientedEdge& use : loop) {
                faces[use.edge].insert(FaceId{static_cast<std::int32_t>(f)});
            }
        }
    }
    for (const auto& [edge, around] : faces) {
        if (around.size() < 2) {
            continue;
        }
        const auto ends = model.edge_vertices(edge);
        REQUIRE(vertex.contains(ends[0].value));
        REQUIRE(vertex.contains(ends[1].value));
        auto chain = on_edge[edge.value];
        std::sort(chain.begin(), chain.end());
        std::vector<Index> nodes{vertex[ends[0].value]};
        for (const auto& [t, i] : chain) {
            nodes.push_back(i);
        }
        nodes.push_back(vertex[ends[1].value]);
        REQUIRE(nodes.size() > 2);
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
            CAPTURE(edge.value, k);
            CHECK(joined.contains(std::minmax(nodes[k], nodes[k + 1])));
        }
    }
}

}  // namespace pavior::test
