#pragma once

#include <pavior/brep/join_solids.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<Index> ids_at(const std::vector<Vec3>& own, std::span<const Vec3> given,
                                        const std::vector<Index>& ids, double distance) {
    HexMesh all;
    for (const Index id : ids) {
        all.nodes.push_back(given[id]);
    }
    all.nodes.insert(all.nodes.end(), own.begin(), own.end());
    std::vector<Index> result(own.size(), no_index);
    for (const auto& [node, earlier] : near_nodes(all, ids.empty() ? 0.0 : distance)) {
        if (node >= ids.size() && earlier < ids.size()) {
            result[node - ids.size()] = ids[earlier];
        }
    }
    return result;
}

PAVIOR_INLINE std::vector<QuadCorners> sorted_quads(std::vector<QuadCorners> quads) {
    for (QuadCorners& quad : quads) {
        std::sort(quad.begin(), quad.end());
    }
    std::sort(quads.begin(), quads.end());
    return quads;
}

PAVIOR_INLINE std::vector<std::pair<Index, Index>> quad_edges(std::span<const QuadCorners> quads) {
    std::vector<std::pair<Index, Index>> result;
    for (const QuadCorners& q : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            result.emplace_back(std::min(q[k], q[(k + 1) % 4]), std::max(q[k], q[(k + 1) % 4]));
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

PAVIOR_INLINE GivenIds given_ids(const BoundaryMesh& given, const SolidEdges& entities, std::span<const FaceId> faces) {
    GivenIds result;
    const auto measure = [&](Index a, Index c) {
        result.shortest = std::min(result.shortest, (given.nodes[a] - given.nodes[c]).norm());
    };
    for (const VertexId v : entities.vertices) {
        if (given.vertices[v.index()] != no_index) {
            result.ids.push_back(given.vertices[v.index()]);
        }
    }
    for (const EdgeId e : entities.edges) {
        const std::vector<Index>& nodes = given.edges[e.index()].nodes;
        result.ids.insert(result.ids.end(), nodes.begin(), nodes.end());
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            measure(nodes[i], nodes[i + 1]);
        }
    }
    for (const FaceId f : faces) {
        const FaceMesh& face = given.faces[f.index()];
        result.ids.insert(result.ids.end(), face.nodes.begin(), face.nodes.end());
        for (const QuadCorners& q : face.quads) {
            for (std::size_t k = 0; k < 4; ++k) {
                measure(face.nodes[q[k]], face.nodes[q[(k + 1) % 4]]);
            }
        }
    }
    std::sort(result.ids.begin(), result.ids.end());
    result.ids.erase(std::unique(result.ids.begin(), result.ids.end()), result.ids.end());
    return result;
}

}  // namespace detail

PAVIOR_INLINE void join_solids(const SolidsMesh& other, std::span<const Index> same, const BoundaryMesh& given,
                               SolidsMesh& mesh) {
    std::vector<Index> number(other.mesh.nodes.size());
    for (std::size_t i = 0; i < number.size(); ++i) {
        number[i] = same[i];
        if (same[i] == no_index) {
            number[i] = static_cast<Index>(mesh.mesh.nodes.size());
            mesh.mesh.nodes.push_back(other.mesh.nodes[i]);
        }
    }
    for (std::size_t h = 0; h < other.mesh.hexes.size(); ++h) {
        HexCorners hex = other.mesh.hexes[h];
        for (Index& corner : hex) {
            corner = number[corner];
        }
        mesh.mesh.hexes.push_back(hex);
        mesh.hex_solid.push_back(other.hex_solid[h]);
    }
    for (std::size_t q = 0; q < other.quads.size(); ++q) {
        if (given.faces[other.quad_face[q].index()].empty()) {
            QuadCorners quad = other.quads[q];
            for (Index& corner : quad) {
                corner = number[corner];
            }
            mesh.quads.push_back(quad);
            mesh.quad_face.push_back(other.quad_face[q]);
        }
    }
}

}  // namespace pavior
