#pragma once

#include <pavior/brep/match_quads.hpp>
#include <pavior/one_to_one/side_grid.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::optional<GridView> find_view(const FaceMesh& face, std::span<const Index> bottom,
                                                std::span<const Index> left) {
    const std::ptrdiff_t step = face.columns + 1;
    const std::ptrdiff_t last_row = step * face.rows;
    for (int way = 0; way < 8; ++way) {
        const bool mirrored = (way & 1) != 0;
        const bool flipped = (way & 2) != 0;
        const bool transposed = (way & 4) != 0;
        GridView view{face.columns, face.rows, (mirrored ? face.columns : 0) + (flipped ? last_row : 0),
                      mirrored ? -1 : 1, flipped ? -step : step};
        if (transposed) {
            std::swap(view.columns, view.rows);
            std::swap(view.right, view.up);
        }
        bool fits = bottom.size() == static_cast<std::size_t>(view.columns) + 1 &&
                    left.size() == static_cast<std::size_t>(view.rows) + 1;
        for (std::size_t i = 0; fits && i < bottom.size(); ++i) {
            fits = face.nodes[view.at(static_cast<int>(i), 0)] == bottom[i];
        }
        for (std::size_t k = 0; fits && k < left.size(); ++k) {
            fits = face.nodes[view.at(0, static_cast<int>(k))] == left[k];
        }
        if (fits) {
            return view;
        }
    }
    return std::nullopt;
}

PAVIOR_INLINE std::vector<Index> chain_ids(const BoundaryMesh& mesh, std::span<const OrientedEdge> chain) {
    std::vector<Index> ids;
    for (const OrientedEdge& use : chain) {
        const std::vector<Index>& nodes = mesh.edges[use.edge.index()].nodes;
        for (std::size_t i = ids.empty() ? 0 : 1; i < nodes.size(); ++i) {
            ids.push_back(use.forward ? nodes[i] : nodes[nodes.size() - 1 - i]);
        }
    }
    return ids;
}

/// Places of the nodes on the edges of \p side, which must be meshed. Nothing if they do not close.
[[nodiscard]] inline std::optional<std::vector<SideNode>> outline_nodes(const BoundaryMesh& mesh,
                                                                        const LinkingSide& side) {
    std::vector<SideNode> result;
    int column = 0;
    int row = 0;
    for (const auto& [use, role] : outline_of(side)) {
        const std::vector<Index> ids = chain_ids(mesh, std::span(&use, 1));
        const int step = role == SideRole::bottom || role == SideRole::right ? 1 : -1;
        for (std::size_t i = 0; i + 1 < ids.size(); ++i) {
            result.push_back({column, row, ids[i]});
            (role == SideRole::bottom || role == SideRole::top ? column : row) += step;
        }
    }
    return column == 0 && row == 0 ? std::optional(std::move(result)) : std::nullopt;
}

PAVIOR_INLINE std::optional<std::vector<SideNode>> lattice_nodes(const BoundaryMesh& mesh, const LinkingSide& side) {
    const FaceMesh& face = mesh.faces[side.face.index()];
    auto result = outline_nodes(mesh, side);
    if (!result) {
        return std::nullopt;
    }
    std::unordered_map<Index, std::array<int, 2>> places;
    for (const SideNode& node : *result) {
        if (!places.emplace(node.id, std::array{node.column, node.row}).second) {
            return std::nullopt;
        }
    }
    std::vector<QuadCorners> quads = side.outward ? face.quads : flipped(face.quads);
    for (QuadCorners& quad : quads) {
        for (Index& corner : quad) {
            corner = face.nodes[corner];
        }
    }
    const HalfEdgeTable table(quads);
    const std::size_t border = result->size();
    std::vector<std::array<Index, 2>> queue;  // edges with a quad on the left, or none
    for (std::size_t i = 0; i < border; ++i) {
        queue.push_back({(*result)[i].id, (*result)[(i + 1) % border].id});
    }
    std::vector<char> done(quads.size(), 0);
    std::size_t placed = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const auto half = table.find(queue[i][0], queue[i][1]);
        if (!half) {
            if (i < border) {
                return std::nullopt;
            }
            continue;
        }
        if (std::exchange(done[*half / 4], 1) != 0) {
            continue;
        }
        ++placed;
        const QuadCorners& quad = quads[*half / 4];
        const auto from = places.at(queue[i][0]);
        const auto to = places.at(queue[i][1]);
        const std::array<int, 2> left{from[1] - to[1], to[0] - from[0]};
        for (const auto& [corner, at] : {std::pair(quad[(*half + 2) % 4], to), {quad[(*half + 3) % 4], from}}) {
            const std::array<int, 2> place{at[0] + left[0], at[1] + left[1]};
            const auto [entry, added] = places.emplace(corner, place);
            if (entry->second != place) {
                return std::nullopt;
            }
            if (added) {
                result->push_back({place[0], place[1], corner});
            }
        }
        for (std::size_t k = 1; k < 4; ++k) {
            queue.push_back({quad[(*half + k + 1) % 4], quad[(*half + k) % 4]});
        }
    }
    return placed == quads.size() ? result : std::nullopt;
}

}  // namespace detail

}  // namespace pavior
