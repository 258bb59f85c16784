#pragma once

#include <pavior/mesh/append_mesh.hpp>

#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE void append_mesh(const HexMesh& other, std::span<const QuadCorners> other_quads, HexMesh& mesh,
                               std::vector<QuadCorners>& quads) {
    const auto shift = static_cast<Index>(mesh.nodes.size());
    const auto append = [shift](const auto& from, auto& to) {
        to.reserve(to.size() + from.size());
        for (auto corners : from) {
            for (Index& node : corners) {
                node += shift;
            }
            to.push_back(corners);
        }
    };
    mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
    append(other.hexes, mesh.hexes);
    append(other_quads, quads);
}

}  // namespace pavior
