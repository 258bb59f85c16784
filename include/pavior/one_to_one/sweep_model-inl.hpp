#pragma once

#include <pavior/one_to_one/sweep_model.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

/// Appends the hexahedra of one solid.
inline void append_solid(ModelMesh& result, const SolidMesh& solid, SolidId id, Renumbering& number) {
    std::vector<Index> ids;
    ids.reserve(solid.nodes.size());
    for (const Index node : solid.nodes) {
        ids.push_back(number(node));
    }
    for (std::size_t k = 0; k < solid.layers; ++k) {
        const std::size_t below = k * solid.level_size;
        const std::size_t above = below + solid.level_size;
        for (const QuadCorners& q : solid.quads) {
            result.mesh.hexes.push_back({ids[below + q[0]], ids[below + q[1]], ids[below + q[2]], ids[below + q[3]],
                                         ids[above + q[0]], ids[above + q[1]], ids[above + q[2]], ids[above + q[3]]});
            result.hex_solid.push_back(id);
        }
    }
}

PAVIOR_INLINE void append_sweeps(ModelMesh& result, std::span<const SolidMesh> solids, Renumbering& number) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
        result.solids[i].first_hex = result.mesh.hexes.size();
        append_solid(result, solids[i], result.solids[i].solid, number);
    }
}

}  // namespace detail

}  // namespace pavior
