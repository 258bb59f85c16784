#pragma once
/// \file
/// Hexahedra of one submapped solid between the meshes of its faces.

#include <pavior/core/compiled.hpp>
#include <pavior/lattice/grid_laplace.hpp>
#include <pavior/lattice/submap_face.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct SolidSubmapOptions {
    bool smooth = true;  ///< repair folded quads of faces and inverted hexahedra
    /// With `smooth`: where the scaled Jacobian stays below this, all inner nodes are optimised.
    double sufficient_jacobian = 0.2;
    Execution execution = sequential;
};

/// One solid as unit cubes of a lattice. Nodes and hexahedra come in the order of the lattice, i running fastest, then
/// j, then k; corners of a hexahedron as in HexCorners with i, j, k for its axes.
struct SubmapSolid {
    std::vector<LatticePoint<3>> lattice;  ///< per node: (i, j, k)
    std::vector<Index> nodes;              ///< per node: its id in BoundaryMesh::nodes
    std::vector<HexCorners> hexes;         ///< positions in `nodes`
    LatticePoint<3> low{}, high{};         ///< box of the lattice
    std::size_t inner_nodes = 0;
    SmoothReport smooth;
};

namespace detail {

/// The lattice of a solid with the node ids of its boundary.
struct SolidShell {
    LogicalGrid<3> grid;
    std::vector<Index> nodes;  ///< per grid node; no_index inside
    LatticeLayers<3> layers;
};

template <brep B>
[[nodiscard]] SolidShell solid_shell(const B& b, const BoundaryMesh& mesh, const SubmapModel& model,
                                     const SubmapTopology& solid, const SubmapNumbers& numbers,
                                     std::span<const std::optional<SubmapFace>> faces) {
    const SolidLattice lattice = solid_lattice(b, model, solid, numbers);
    std::vector<LatticeFacet<3>> facets;
    for (std::size_t f = 0; f < solid.sides.size(); ++f) {
        const FaceId id = solid.sides[f].face.face;
        PAVIOR_ASSERT(faces[id.index()].has_value());
        faces[id.index()]->grid.for_each_cell([&](const LatticePoint<2>& cell) {
            facets.push_back(lattice.sides[f].facet(cell, static_cast<Index>(f)));
        });
    }
    SolidShell shell{LogicalGrid<3>(facets), {}, {}};
    if (!shell.grid.ok()) {
        const int tag = b.tag(2, solid.sides[shell.grid.overlap().front()].face.face.index());
        throw InputError(ErrorCode::infeasible_intervals,
                         "the numbers of intervals make the solid overlap itself at face " + std::to_string(tag),
                         {tag});
    }
    shell.nodes.assign(shell.grid.node_count(), no_index);
    LayerWidths<3> widths(shell.grid);
    for (std::size_t f = 0; f < solid.sides.size(); ++f) {
        const FaceId id = solid.sides[f].face.face;
        const FaceMesh& face = mesh.faces[id.index()];
        const LogicalGrid<2>& grid = faces[id.index()]->grid;
        const SidePlace& place = lattice.sides[f];
        grid.for_each_node([&](Index n, const LatticePoint<2>& p) {
            Index& at = shell.nodes[shell.grid.node(place(p))];
            if (at != no_index && at != face.nodes[n]) {
                const int tag = b.tag(2, id.index());
                throw InputError(ErrorCode::infeasible_intervals,
                                 "the numbers of intervals make face " + std::to_string(tag) + " touch another", {tag});
            }
            at = face.nodes[n];
        });
        grid.for_each_cell([&](const LatticePoint<2>& cell) {
            for (std::size_t c = 0; c < 2; ++c) {
                const SignedAxis d = c == 0 ? place.side.s : place.side.t;
                for (int far = 0; far < 2; ++far) {  // both segments of the cell along s, then along t
                    LatticePoint<2> from = cell;
                    from[1 - c] += far;
                    LatticePoint<2> to = from;
                    to[c] += 1;
                    const int x = std::min(place(from)[d.axis()], place(to)[d.axis()]);
                    const Vec3 way = mesh.nodes[face.nodes[grid.node(to)]] - mesh.nodes[face.nodes[grid.node(from)]];
                    widths.add(d.axis(), x, way.norm());
                }
            }
        });
    }
    shell.layers.width = widths.take();
    std::array<std::set<int>, 3> planes;
    for (const auto& [vertex, point] : lattice.vertices) {
        for (std::size_t a = 0; a < 3; ++a) {
            planes[a].insert(point[a]);
        }
    }
    for (std::size_t a = 0; a < 3; ++a) {
        shell.layers.planes[a].assign(planes[a].begin(), planes[a].end());
    }
    return shell;
}

[[nodiscard]] PAVIOR_INLINE std::vector<HexCorners> lattice_hexes(const LogicalGrid<3>& grid);

/// Repairs inverted hexahedra and, where the worst is still poor, optimises all inner nodes. Without options.smooth
/// only the report is made.
PAVIOR_INLINE SmoothReport improve_solid(std::vector<Vec3>& points, std::span<const HexCorners> hexes,
                                         std::vector<std::uint8_t> fixed, const SolidSubmapOptions& options);

}  // namespace detail

/// Fills \p solid with hexahedra. Its faces must be meshed (\p faces by face id, as mesh_submap_face() returned them);
/// the inner nodes are added to \p mesh. They are placed by a discrete harmonic map whose layers are as wide as those
/// of the boundary (place_inner_nodes()); inverted hexahedra are then repaired (untangle_hexes(), boundary fixed).
/// Every inner node has six neighbours and eight hexahedra, every inner edge four.
/// O(lattice points of the bounding box). \throws InputError infeasible_intervals if the lattice overlaps itself.
template <brep B>
SubmapSolid submap_solid(const B& b, BoundaryMesh& mesh, const SubmapModel& model, const SubmapTopology& solid,
                         const SubmapNumbers& numbers, std::span<const std::optional<SubmapFace>> faces,
                         const SolidSubmapOptions& options = {}) {
    detail::SolidShell shell = detail::solid_shell(b, mesh, model, solid, numbers, faces);
    SubmapSolid result;
    result.hexes = detail::lattice_hexes(shell.grid);
    result.low = shell.grid.low();
    result.high = shell.grid.high();
    std::vector<Vec3> points(shell.nodes.size(), Vec3::Zero());
    std::vector<std::uint8_t> fixed(points.size(), 0);
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (shell.nodes[n] != no_index) {
            points[n] = mesh.nodes[shell.nodes[n]];
            fixed[n] = 1;
        } else {
            ++result.inner_nodes;
        }
    }
    place_inner_nodes(shell.grid, shell.layers, points);
    result.smooth = detail::improve_solid(points, result.hexes, std::move(fixed), options);
    shell.grid.for_each_node([&](Index, const LatticePoint<3>& p) { result.lattice.push_back(p); });
    result.nodes = std::move(shell.nodes);
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (result.nodes[n] == no_index) {
            result.nodes[n] = mesh.add_node(points[n]);
        }
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_solid-inl.hpp>
#endif
