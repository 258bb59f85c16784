#pragma once

#include <pavior/block/block_mesh.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

inline void check_strata(const BlockMesh& mesh) {
    constexpr std::array<int, 8> dimensions{0, 1, 2, 1, 1, 2, 3, 2};
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
        for (std::size_t k = 0; k < 8; ++k) {
            const Index i = mesh.hexes[h][k];
            if (i >= mesh.nodes.size() || mesh.nodes[i].dimension != dimensions[k]) {
                throw InputError(ErrorCode::bad_index,
                                 "corner " + std::to_string(k) + " of block " + std::to_string(h) +
                                     " does not come from an entity of dimension " + std::to_string(dimensions[k]),
                                 {static_cast<std::int64_t>(h)});
            }
        }
    }
}

inline void number_edges(BlockMesh& mesh) {
    std::vector<std::array<Index, 2>>& edges = mesh.edges;
    const auto ends = [](const HexCorners& c, std::size_t e) {
        return std::array<Index, 2>{c[static_cast<std::size_t>(hex_edges[e][0])],
                                    c[static_cast<std::size_t>(hex_edges[e][1])]};
    };
    for (const HexCorners& c : mesh.hexes) {
        for (std::size_t e = 0; e < 12; ++e) {
            edges.push_back(ends(c, e));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    mesh.hex_edges.resize(mesh.hexes.size());
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
        for (std::size_t e = 0; e < 12; ++e) {
            const auto at = std::lower_bound(edges.begin(), edges.end(), ends(mesh.hexes[h], e));
            mesh.hex_edges[h][e] = static_cast<Index>(at - edges.begin());
        }
    }
}

/// A quad of four block nodes turned so that it starts at the node of lowest dimension.
[[nodiscard]] inline QuadCorners from_lowest(const BlockMesh& mesh, const QuadCorners& c) {
    std::size_t low = 0;
    for (std::size_t k = 1; k < 4; ++k) {
        low = mesh.nodes[c[k]].dimension < mesh.nodes[c[low]].dimension ? k : low;
    }
    return {c[low], c[(low + 1) % 4], c[(low + 2) % 4], c[(low + 3) % 4]};
}

inline void number_quads(BlockMesh& mesh) {
    mesh.hex_quads.resize(mesh.hexes.size());
    const HexMeshView<Vec3, HexCorners> view{{}, mesh.hexes};
    struct Use {
        QuadCorners key;
        Index hex;
        std::uint32_t face;
    };
    std::vector<Use> uses;
    uses.reserve(6 * mesh.hexes.size());
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
        for (std::uint32_t f = 0; f < 6; ++f) {
            QuadCorners key = hex_face(view.hexes[h], f);
            std::sort(key.begin(), key.end());
            uses.push_back({key, static_cast<Index>(h), f});
        }
    }
    std::sort(uses.begin(), uses.end(),
              [](const Use& a, const Use& b) { return a.key != b.key ? a.key < b.key : a.hex < b.hex; });
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const Use& use = uses[i];
        if (i == 0 || use.key != uses[i - 1].key) {
            mesh.quads.push_back(from_lowest(mesh, hex_face(mesh.hexes[use.hex], use.face)));
            mesh.quad_hexes.push_back({use.hex, no_index});
        } else if (mesh.quad_hexes.back()[1] == no_index) {
            mesh.quad_hexes.back()[1] = use.hex;
        } else {
            throw InputError(ErrorCode::invalid_dual, "three blocks share a quad", {use.hex});
        }
        mesh.hex_quads[use.hex][use.face] = static_cast<Index>(mesh.quads.size() - 1);
    }
}

inline void number_sheets(BlockMesh& mesh) {
    DisjointSets sets(mesh.edges.size());
    for (const auto& e : mesh.hex_edges) {
        for (std::size_t direction = 0; direction < 3; ++direction) {
            for (std::size_t k = 1; k < 4; ++k) {
                sets.unite(e[4 * direction], e[4 * direction + k]);
            }
        }
    }
    mesh.sheet_count = number_sets(sets, mesh.sheets, [](Index) { return true; });
}

}  // namespace detail

PAVIOR_INLINE BlockMesh make_block_mesh(std::vector<BlockNode> nodes, std::vector<HexCorners> hexes) {
    BlockMesh mesh;
    mesh.nodes = std::move(nodes);
    mesh.hexes = std::move(hexes);
    std::array<Index, 4> count{};
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const BlockNode& node = mesh.nodes[i];
        if (node.dimension > 3 || node.id != count[node.dimension] ||
            (i > 0 && node.dimension < mesh.nodes[i - 1].dimension)) {
            throw InputError(ErrorCode::bad_index, "block node " + std::to_string(i) + " is out of order",
                             {static_cast<std::int64_t>(i)});
        }
        ++count[node.dimension];
    }
    for (std::size_t d = 0; d < 4; ++d) {
        mesh.first[d + 1] = mesh.first[d] + count[d];
    }
    detail::check_strata(mesh);
    detail::number_edges(mesh);
    detail::number_quads(mesh);
    detail::number_sheets(mesh);
    return mesh;
}

}  // namespace pavior
