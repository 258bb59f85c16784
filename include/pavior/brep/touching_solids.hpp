#pragma once
/// \file
/// Solids of a CAD model that hang together.

#include <pavior/brep/brep.hpp>
#include <pavior/core/disjoint_sets.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Groups those of \p solids that share a vertex (or an edge or a face, which have vertices), directly or through
/// others of them. Groups, and the solids in each, come in the order of \p solids. O(uses of edges).
template <brep B>
[[nodiscard]] std::vector<std::vector<SolidId>> touching_solids(const B& b, std::span<const SolidId> solids) {
    DisjointSets<std::size_t> sets(solids.size());
    std::vector<std::size_t> vertex_owner(b.vertex_count(), no_position);
    std::vector<std::size_t> face_owner(b.face_count(), no_position);
    const auto join = [&](std::size_t& owner, std::size_t s) {
        owner = owner == no_position ? s : owner;
        sets.unite(owner, s);
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
        groups[sets.root(s)].push_back(solids[s]);
    }
    std::erase_if(groups, [](const auto& group) { return group.empty(); });
    return groups;
}

}  // namespace pavior
