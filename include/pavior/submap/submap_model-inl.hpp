#pragma once

#include <pavior/submap/submap_model.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void append_submap(SolidsMesh& result, const SubmapTopology& topology, const SubmapSolid& solid,
                                 Renumbering& number, std::vector<SubmapSolidReport>& reports) {
    reports.push_back({topology.solid, result.mesh.hexes.size(), solid.hexes.size(), solid.low, solid.high,
                       topology.deviation, solid.smooth});
    std::vector<Index> ids;
    ids.reserve(solid.nodes.size());
    for (const Index node : solid.nodes) {
        ids.push_back(number(node));
    }
    for (const HexCorners& hex : solid.hexes) {
        HexCorners corners{};
        for (std::size_t c = 0; c < corners.size(); ++c) {
            corners[c] = ids[hex[c]];
        }
        result.mesh.hexes.push_back(corners);
        result.hex_solid.push_back(topology.solid);
    }
}

}  // namespace detail

PAVIOR_INLINE double SubmappedMesh::min_scaled_jacobian() const {
    double result = 1.0;
    for (const SubmapSolidReport& solid : solids) {
        result = std::min(result, solid.smooth.min_det_after);
    }
    return result;
}

}  // namespace pavior
