#pragma once
/// \file
/// The structured meshes of linking sides, and the loops of all levels that they make up.

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/model/boundary_mesh.hpp>
#include <pavior/sweep/transfinite.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
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

}  // namespace detail

/// Quads of the structured mesh of a linking side whose rows run along its bottom, counter-clockwise about the face's
/// own normal.
[[nodiscard]] inline std::vector<QuadCorners> side_quads(const LinkingSide& side, std::size_t columns,
                                                         std::size_t rows) {
    std::vector<QuadCorners> quads = structured_quads(columns, rows);
    return side.outward ? quads : detail::flipped(std::move(quads));
}

/// Node ids of the structured mesh of a linking side as the sweep sees it: (rows + 1) x (columns + 1), row by row from
/// the source, each along the source loop. \throws UnmeshableError not_sweepable if the face is meshed otherwise
/// (unstructured, or with its logical sides elsewhere).
template <brep B>
[[nodiscard]] std::vector<Index> side_ids(const B& b, const BoundaryMesh& mesh, const LinkingSide& side) {
    const FaceMesh& face = mesh.faces[side.face.index()];
    const std::vector<Index> bottom = detail::chain_ids(mesh, side.bottom);
    const std::vector<Index> left = detail::chain_ids(mesh, side.left);
    const std::optional<detail::GridView> view =
        face.structured() ? detail::find_view(face, bottom, left) : std::nullopt;
    if (!view) {
        const int tag = b.tag(2, side.face.index());
        throw UnmeshableError(ErrorCode::not_sweepable,
                              "face " + std::to_string(tag) +
                                  " is a linking side, but the solid on its other side needs another mesh on it",
                              {tag});
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
        const std::size_t columns = result.offsets[l + 1] - result.offsets[l];
        for (std::size_t s = 0; s < sweep.loops[l].size(); ++s) {
            const SidePlacement& at = places[l][s];
            const std::vector<Index> ids = side_ids(b, mesh, sweep.loops[l][s]);
            const auto width = static_cast<std::size_t>(at.columns) + 1;
            for (std::size_t n = 0; n < ids.size(); ++n) {
                const std::size_t level = static_cast<std::size_t>(at.row) + n / width;
                const std::size_t column = (static_cast<std::size_t>(at.column) + n % width) % columns;
                result.ids[level * result.level_size() + result.offsets[l] + column] = ids[n];
            }
        }
    }
    PAVIOR_ASSERT(std::find(result.ids.begin(), result.ids.end(), no_node) == result.ids.end());
    return result;
}

}  // namespace pavior
