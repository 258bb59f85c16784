#pragma once
/// \file
/// Several meshes in the arrays of one.

#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <span>
#include <vector>

namespace pavior {

/// Appends the nodes and hexahedra of \p other to \p mesh, and the quads on it (ids of its own nodes) to \p quads, all
/// ids moved behind the nodes that are there. Nodes are not merged. O(other).
inline void append_mesh(const HexMesh& other, std::span<const QuadCorners> other_quads, HexMesh& mesh,
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
