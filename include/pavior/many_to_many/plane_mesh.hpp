#pragma once
/// \file
/// Quads for all cells of an arrangement, conforming along its edges.

#include <pavior/core/assert.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/many_to_many/plane_arrangement.hpp>
#include <pavior/many_to_many/plane_region.hpp>
#include <pavior/sweep/folded_quads.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// The quads of an arrangement. Nodes 0 .. v-1 are its v vertices; then come those of the edges, edge by edge; then the
/// inner nodes, cell by cell.
struct PlaneMesh {
    std::vector<Vec2> nodes;
    std::size_t edge_nodes = 0;              ///< nodes of vertices and edges
    std::vector<std::vector<Index>> edges;   ///< nodes of each edge, both ends included
    std::vector<QuadCorners> quads;          ///< cell by cell, counter-clockwise
    std::vector<std::size_t> cell_quads{0};  ///< quads of cell c: [cell_quads[c], cell_quads[c + 1])

    [[nodiscard]] std::size_t cell_count() const { return cell_quads.size() - 1; }
};

namespace detail {

/// Points at equal arc length on a polyline, both ends included.
[[nodiscard]] PAVIOR_INLINE std::vector<Vec2> divide_polyline(std::span<const Vec2> points, int intervals);

/// Nodes of the boundary of a cell, loop by loop.
[[nodiscard]] PAVIOR_INLINE std::pair<std::vector<Index>, std::vector<std::size_t>> cell_boundary(
    const PlaneMesh& mesh, const PlaneCell& cell);

/// Where a boundary passes a node twice, its points there are drawn a little into the region, so that the mesher sees
/// simple loops.
PAVIOR_INLINE void part_repeated(const std::vector<Index>& nodes, PlaneRegion& region);

/// True if a quad has a corner that is no corner: folded, or straight as where two of its edges are those of a line.
[[nodiscard]] PAVIOR_INLINE bool has_flat_corner(std::span<const Vec2> nodes, std::span<const QuadCorners> quads);

/// Appends the quads of one cell.
template <region_mesher M>
void mesh_cell(const PlaneCell& cell, M&& mesher, PlaneMesh& mesh) {
    auto [nodes, offsets] = cell_boundary(mesh, cell);
    PlaneRegion region;
    region.offsets = std::move(offsets);
    for (const Index i : nodes) {
        region.points.push_back(mesh.nodes[i]);
    }
    part_repeated(nodes, region);
    if (!(signed_area(std::span(region.points).first(region.offsets[1])) > 0)) {  // few intervals across a thin cell
        throw Error(ErrorCode::cad_failure,
                    "a cell is thinner than the chords of its " + std::to_string(nodes.size()) + " boundary nodes");
    }
    const PlaneQuadMesh quads = mesher(region);
    PAVIOR_ASSERT(quads.nodes.size() >= nodes.size());
    PlaneQuadMesh real = quads;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        real.nodes[i] = mesh.nodes[nodes[i]];
    }
    if (has_flat_corner(real.nodes, real.quads)) {
        throw Error(ErrorCode::cad_failure,
                    "a cell of " + std::to_string(nodes.size()) + " boundary nodes cannot be filled with quads");
    }
    for (std::size_t i = nodes.size(); i < quads.nodes.size(); ++i) {
        nodes.push_back(static_cast<Index>(mesh.nodes.size()));
        mesh.nodes.push_back(quads.nodes[i]);
    }
    for (const QuadCorners& quad : quads.quads) {
        mesh.quads.push_back({nodes[quad[0]], nodes[quad[1]], nodes[quad[2]], nodes[quad[3]]});
    }
}

}  // namespace detail

/// Divides the edges of \p plane into \p intervals each, at equal arc length, moves the nodes by
/// place(edge, point) (onto the true curve, say), and fills the cells that are \p wanted (one flag each) with \p
/// mesher. An Error cad_failure of \p mesher, or one because a quad is folded or flat at a corner, is passed to
/// failed(cell, error), and that cell has no quads then; anything else that it throws passes through.
template <class Place, region_mesher M, class Failed>
[[nodiscard]] PlaneMesh mesh_plane(const PlaneArrangement& plane, std::span<const int> intervals,
                                   std::span<const char> wanted, Place&& place, M&& mesher, Failed&& failed) {
    PlaneMesh mesh;
    mesh.nodes = plane.vertices;
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        const PlaneEdge& edge = plane.edges[e];
        const std::vector<Vec2> points = detail::divide_polyline(edge.points, intervals[e]);
        std::vector<Index> nodes{edge.vertices[0]};
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            nodes.push_back(static_cast<Index>(mesh.nodes.size()));
            mesh.nodes.push_back(place(static_cast<Index>(e), points[i]));
        }
        nodes.push_back(edge.vertices[1]);
        mesh.edges.push_back(std::move(nodes));
    }
    mesh.edge_nodes = mesh.nodes.size();
    for (Index cell = 0; cell < plane.cells.size(); ++cell) {
        try {
            if (wanted[cell] != 0) {
                detail::mesh_cell(plane.cells[cell], mesher, mesh);
            }
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cad_failure) {
                throw;
            }
            failed(cell, error);
        }
        mesh.cell_quads.push_back(mesh.quads.size());
    }
    return mesh;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/plane_mesh-inl.hpp>
#endif
