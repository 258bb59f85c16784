#pragma once

#include <pavior/brep/node_entities.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_mesh_entities(std::span<const Vec3> nodes, std::span<const HexCorners> hexes,
                                       std::span<const SolidId> hex_solid, std::span<const QuadCorners> quads,
                                       std::span<const FaceId> quad_face, std::size_t solids, std::size_t faces,
                                       const NodeEntityOptions& options) {
    const auto refuse = [](ErrorCode code, const std::string& message, std::size_t id) {
        throw InputError(code, message + " " + std::to_string(id), {static_cast<std::int64_t>(id)});
    };
    if (hexes.size() != hex_solid.size() || quads.size() != quad_face.size()) {
        throw InputError(ErrorCode::size_mismatch, "each hexahedron needs a solid, each quad a face");
    }
    if (!(options.tolerance >= 0 && options.tolerance < 1)) {
        throw InputError(ErrorCode::bad_option, "the tolerance must be at least 0 and below 1");
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].allFinite()) {
            refuse(ErrorCode::not_finite, "a coordinate is not finite: node", i);
        }
    }
    const auto beyond = [&](Index i) { return i >= nodes.size(); };
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        if (!hex_solid[h].valid() || hex_solid[h].index() >= solids ||
            std::any_of(hexes[h].begin(), hexes[h].end(), beyond)) {
            refuse(ErrorCode::bad_index, "a node or the solid does not exist: hexahedron", h);
        }
    }
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const QuadCorners& c = quads[q];
        const bool twice = c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3];
        if (!quad_face[q].valid() || quad_face[q].index() >= faces || twice ||
            std::any_of(c.begin(), c.end(), beyond)) {
            refuse(ErrorCode::bad_index, "a node or the face does not exist, or a node comes twice: quad", q);
        }
    }
}

}  // namespace detail

}  // namespace pavior
