#pragma once
/// \file
/// The structured meshes of linking sides, and the loops of all levels that they make up.

#include <pavior/one_to_one/sweep_topology.hpp>
#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/match_quads.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/sweep/transfinite.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// One of the eight ways to look at a structured face: how to step along its rows and columns.
struct GridView {
    int columns = 0, rows = 0;
    std::ptrdiff_t origin = 0, right = 0, up = 0;

    [[nodiscard]] std::size_t at(int i, int k) const { return static_cast<std::size_t>(origin + i * right + k * up); }
};

/// The view of \p face whose bottom row and left column are the node ids given, if there is one.
[[nodiscard]] inline std::optional<GridView> find_view(const FaceMesh& face, std::span<const Index> bottom,
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

[[nodiscard]] inline std::vector<Index> chain_ids(const BoundaryMesh& mesh, std::span<const OrientedEdge> chain) {
    std::vector<Index> ids;
    for (const OrientedEdge& use : chain) {
        const std::vector<Index>& nodes = mesh.edges[use.edge.index()].nodes;
        for (std::size_t i = ids.empty() ? 0 : 1; i < nodes.size(); ++i) {
            ids.push_back(use.forward ? nodes[i] : nodes[nodes.size() - 1 - i]);
        }
    }
    return ids;
}

/// A node of a linking side on the grid of its loop, counted from the start of the first bottom edge.
struct SideNode {
    int column = 0, row = 0;
    Index id = no_node;
};

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

/// Places of all nodes of a side that is no rectangle, spread from its edges over the quads of its mesh. Nothing if the
/// quads are not a part of the grid with these edges. O(n) hash look-ups.
[[nodiscard]] inline std::optional<std::vector<SideNode>> lattice_nodes(const BoundaryMesh& mesh,
                                                                        const LinkingSide& side) {
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

/// Quads of the structured mesh of a linking side whose rows run along its bottom, counter-clockwise about the face's
/// own normal.
[[nodiscard]] inline std::vector<QuadCorners> side_quads(const LinkingSide& side, std::size_t columns,
                                                         std::size_t rows) {
    std::vector<QuadCorners> quads = structured_quads(columns, rows);
    return side.outward ? quads : detail::flipped(std::move(quads));
}

namespace detail {

/// "Face ... needs another mesh."
template <brep B>
[[nodiscard]] UnmeshableError wrong_side(const B& b, FaceId face) {
    const int tag = b.tag(2, face.index());
    return {
        ErrorCode::not_sweepable,
        "face " + std::to_string(tag) + " is a linking side, but the solid on its other side needs another mesh on it",
        {tag}};
}

}  // namespace detail

/// Node ids of the structured mesh of a linking side with four corners as the sweep sees it: (rows + 1) x
/// (columns + 1), row by row from the source, each along the source loop. \throws UnmeshableError not_sweepable if the
/// face is meshed otherwise (unstructured, or with its logical sides elsewhere).
template <brep B>
[[nodiscard]] std::vector<Index> side_ids(const B& b, const BoundaryMesh& mesh, const LinkingSide& side) {
    const FaceMesh& face = mesh.faces[side.face.index()];
    const std::vector<Index> bottom = detail::chain_ids(mesh, side.bottom);
    const std::vector<Index> left = detail::chain_ids(mesh, side.left);
    const std::optional<detail::GridView> view =
        face.structured() ? detail::find_view(face, bottom, left) : std::nullopt;
    if (!view) {
        throw detail::wrong_side(b, side.face);
    }
    std::vector<Index> ids;
    ids.reserve(bottom.size() * left.size());
    for (int k = 0; k <= view->rows; ++k) {
        for (int i = 0; i <= view->columns; ++i) {
            ids.push_back(face.nodes[view->at(i, k)]);
        }
    }
    return ids;
}

namespace detail {

/// The nodes of the mesh of a linking side on the grid. \throws UnmeshableError as side_ids()
template <brep B>
[[nodiscard]] std::vector<SideNode> side_nodes(const B& b, const BoundaryMesh& mesh, const LinkingSide& side,
                                               const SidePlacement& at) {
    if (!side.rectangle()) {
        auto nodes = lattice_nodes(mesh, side);
        return nodes ? std::move(*nodes) : throw wrong_side(b, side.face);
    }
    const std::vector<Index> ids = side_ids(b, mesh, side);
    const int width = at.columns + 1;
    std::vector<SideNode> nodes;
    nodes.reserve(ids.size());
    for (int n = 0; n < static_cast<int>(ids.size()); ++n) {
        nodes.push_back({n % width, n / width, ids[static_cast<std::size_t>(n)]});
    }
    return nodes;
}

}  // namespace detail

/// The boundary of a sweep at every level.
struct LevelIds {
    std::vector<std::size_t> offsets{0};  ///< of the loops in one level
    std::vector<Index> ids;               ///< (layers + 1) x offsets.back() node ids, level by level
    std::size_t layers = 0;

    [[nodiscard]] std::size_t level_size() const { return offsets.back(); }
    [[nodiscard]] std::span<const Index> level(std::size_t k) const {
        return std::span(ids).subspan(k * level_size(), level_size());
    }
};

/// Puts the linking sides of \p sweep together: node ids of its loops at all levels. Loops are those of the source, in
/// its order, each from the start of its first edge. Every linking side must be meshed. \p intervals by edge id.
/// \throws what place_sides() and side_ids() throw
template <brep B>
[[nodiscard]] LevelIds level_ids(const B& b, const BoundaryMesh& mesh, const SweepTopology& sweep,
                                 std::span<const int> intervals) {
    const std::vector<std::vector<SidePlacement>> places = place_sides(sweep, intervals);
    LevelIds result;
    for (std::size_t l = 0; l < sweep.loops.size(); ++l) {
        result.offsets.push_back(result.offsets.back() +
                                 static_cast<std::size_t>(chain_intervals(sweep.source_loops[l], intervals)));
        for (const SidePlacement& at : places[l]) {
            result.layers = std::max(result.layers, static_cast<std::size_t>(at.row + at.rows));
        }
    }
    result.ids.assign((result.layers + 1) * result.level_size(), no_node);
    for (std::size_t l = 0; l < sweep.loops.size(); ++l) {
        const auto columns = static_cast<int>(result.offsets[l + 1] - result.offsets[l]);
        for (std::size_t s = 0; s < sweep.loops[l].size(); ++s) {
            const SidePlacement& at = places[l][s];
            for (const detail::SideNode& node : detail::side_nodes(b, mesh, sweep.loops[l][s], at)) {
                const auto level = static_cast<std::size_t>(at.row + node.row);
                const int column = (at.column + node.column) % columns;
                result.ids[level * result.level_size() + result.offsets[l] +
                           static_cast<std::size_t>(column < 0 ? column + columns : column)] = node.id;
            }
        }
    }
    PAVIOR_ASSERT(std::find(result.ids.begin(), result.ids.end(), no_node) == result.ids.end());
    return result;
}

}  // namespace pavior
