#pragma once

#include <pavior/core/error.hpp>
#include <pavior/core/large_array.hpp>
#include <pavior/sweep/sweep_mesh.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE HexCorners SweepNumbering::hex(std::size_t k, const QuadCorners& quad) const {
    HexCorners corners;
    for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = static_cast<Index>(node(k, quad[c]));
        corners[c + 4] = static_cast<Index>(node(k + 1, quad[c]));
    }
    return corners;
}

PAVIOR_INLINE void SweepNumbering::check(std::size_t quads) const {
    constexpr std::size_t limit = std::numeric_limits<Index>::max();
    if (level_size != 0 && (layers + 1 > limit / level_size || layers * quads > limit)) {
        throw InputError(ErrorCode::overflow, std::to_string(layers) + " layers of " + std::to_string(level_size) +
                                                  " nodes and " + std::to_string(quads) +
                                                  " quads are more than ids of 32 bits can name");
    }
}

PAVIOR_INLINE SweepMesh::SweepMesh(std::vector<Vec3> nodes, std::vector<QuadCorners> quads, std::size_t layers)
    : nodes_(std::move(nodes)), quads_(std::move(quads)), numbering_{nodes_.size() / (layers + 1), layers} {
    if (nodes_.size() % (layers + 1) != 0) {
        throw InputError(ErrorCode::size_mismatch,
                         std::to_string(nodes_.size()) + " nodes are not " + std::to_string(layers + 1) + " levels");
    }
    numbering_.check(quads_.size());
}

PAVIOR_INLINE std::vector<HexCorners> SweepMesh::hexes() const {
    std::vector<HexCorners> out = large_array<HexCorners>(hex_count());
    for (std::size_t k = 0; k < layer_count(); ++k) {
        for (const QuadCorners& quad : quads_) {
            out.push_back(numbering_.hex(k, quad));
        }
    }
    return out;
}

}  // namespace pavior
