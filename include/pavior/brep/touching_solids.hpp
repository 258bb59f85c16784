#pragma once
/// \file
/// Solids of a CAD model that hang together.

#include <pavior/brep/brep.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace pavior {

/// Groups those of \p solids that share a vertex (or an edge or a face, which have vertices), directly or through
/// others of them. Groups, and the solids in each, come in the order of \p solids. O(uses of edges).
template <brep B>
[[nodiscard]] std::vector<std::vector<SolidId>> touching_solids(const B& b, std::span<const SolidId> solids) {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> root(solids.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t s) {
        while (root[s] != s) {
            s = root[s] = root[root[s]];
        }
        return s;
    };
    std::vector<std::size_t> vertex_owner(b.vertex_count(), none);
    std::vector<std::size_t> face_owner(b.face_count(), none);
    const auto join = [&](std::size_t& owner, std::size_t s) {
        owner = owner == none ? s : owner;
        const auto [low, high] = std::minmax({find(owner), find(s)});
        root[high] = low;
    };
    for (std::size_t s = 0; s < solids.size(); ++s) {
        for (const OrientedFace& face : b.solid_faces(solids[s])) {
            join(face_owner[face.face.index()], s);  // it may have no edges
            for (const EdgeLoop& loop : b.face_loops(face.face)) {
                for (const OrientedEdge& use : loop) {
                    for (const VertexId v : b.edge_vertices(use.edge)) {
                        join(vertex_owner[v.index()], s);
                    }
                }
            }
        }
    }
    std::vector<std::vector<SolidId>> groups(solids.size());
    for (std::size_t s = 0; s < solids.size(); ++s) {
        groups[find(s)].push_back(solids[s]);
    }
    std::erase_if(groups, [](const auto& group) { return group.empty(); });
    return groups;
}

}  // namespace pavior
