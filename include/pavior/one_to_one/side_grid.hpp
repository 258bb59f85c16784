#pragma once
/// \file
/// The structured meshes of linking sides, and the loops of all levels that they make up.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>
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
[[nodiscard]] PAVIOR_INLINE std::optional<GridView> find_view(const FaceMesh& face, std::span<const Index> bottom,
                                                              std::span<const Index> left);

[[nodiscard]] PAVIOR_INLINE std::vector<Index> chain_ids(const BoundaryMesh& mesh, std::span<const OrientedEdge> chain);

/// A node of a linking side on the grid of its loop, counted from the start of the first bottom edge.
struct SideNode {
    int column = 0, row = 0;
    Index id = no_index;
};

/// Places of all nodes of a side that is no rectangle, spread from its edges over the quads of its mesh. Nothing if the
/// quads are not a part of the grid with these edges. O(n) hash look-ups.
[[nodiscard]] PAVIOR_INLINE std::optional<std::vector<SideNode>> lattice_nodes(const BoundaryMesh& mesh,
                                                                               const LinkingSide& side);

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
    result.ids.assign((result.layers + 1) * result.level_size(), no_index);
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
    PAVIOR_ASSERT(std::find(result.ids.begin(), result.ids.end(), no_index) == result.ids.end());
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/side_grid-inl.hpp>
#endif
