#pragma once

#include <pavior/brep/detail/entity_incidences.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE std::vector<EdgeId> Incidences::edges_between(std::span<const FaceId> set) const {
    std::vector<EdgeId> result;
    for (const EdgeId e : face_edges[set[0].index()]) {
        const std::vector<FaceId>& faces = edge_faces[e.index()];
        if (std::includes(faces.begin(), faces.end(), set.begin(), set.end())) {
            result.push_back(e);
        }
    }
    if (!result.empty()) {
        return result;
    }
    std::set<EdgeId> all;
    for (const FaceId f : set) {
        for (const EdgeId e : face_edges[f.index()]) {
            if (!seam(e)) {
                all.insert(e);
            }
        }
    }
    return {all.begin(), all.end()};
}

PAVIOR_INLINE std::vector<VertexId> Incidences::vertices_between(std::span<const FaceId> set) const {
    const FaceId least = *std::min_element(set.begin(), set.end(), [&](FaceId f, FaceId g) {
        return face_vertices[f.index()].size() < face_vertices[g.index()].size();
    });
    std::vector<VertexId> result;
    for (const VertexId v : face_vertices[least.index()]) {
        const std::vector<FaceId>& faces = vertex_faces[v.index()];
        if (std::includes(faces.begin(), faces.end(), set.begin(), set.end())) {
            result.push_back(v);
        }
    }
    return result;
}

PAVIOR_INLINE bool Incidences::seam(EdgeId e) const {
    const std::vector<FaceId>& faces = edge_faces[e.index()];
    return faces.size() == 1 &&
           std::binary_search(face_seams[faces[0].index()].begin(), face_seams[faces[0].index()].end(), e);
}

PAVIOR_INLINE bool Incidences::pole(VertexId v) const {
    const std::vector<EdgeId>& edges = vertex_edges[v.index()];
    return std::all_of(edges.begin(), edges.end(), [&](EdgeId e) { return seam(e); });
}

PAVIOR_INLINE QuadSkeleton quad_skeleton(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                         std::span<const FaceId> faces) {
    QuadSkeleton result{EdgeTable(nodes.size(), quads.size(), [&](Index q) { return quads[q]; }), {}, {}, {}, {}};
    for (std::size_t q = 0; q < quads.size(); ++q) {
        for (const Index i : quads[q]) {
            result.node_faces.emplace_back(i, faces[q]);
        }
    }
    std::sort(result.node_faces.begin(), result.node_faces.end());
    result.node_faces.erase(std::unique(result.node_faces.begin(), result.node_faces.end()), result.node_faces.end());
    result.shortest.assign(nodes.size(), std::numeric_limits<double>::infinity());
    std::map<std::vector<FaceId>, Index> number;
    std::vector<FaceId> set;
    result.edges.for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
        const double length = (nodes[high] - nodes[low]).norm();
        set.clear();
        for (const EdgeTable::Use& use : uses) {
            set.push_back(faces[use.quad]);
        }
        std::sort(set.begin(), set.end());
        set.erase(std::unique(set.begin(), set.end()), set.end());
        const bool line = set.size() > 1 || uses.size() == 1;
        const Index at = line ? number.try_emplace(set, static_cast<Index>(number.size())).first->second : 0;
        for (const Index i : {low, high}) {
            result.shortest[i] = std::min(result.shortest[i], length);
            if (line) {
                result.node_sets.emplace_back(i, at);
            }
        }
    });
    std::sort(result.node_sets.begin(), result.node_sets.end());
    result.sets.resize(number.size());
    for (const auto& [members, at] : number) {
        result.sets[at] = members;
    }
    return result;
}

}  // namespace pavior::detail
