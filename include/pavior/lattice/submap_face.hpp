#pragma once
/// \file
/// Structured mesh of one submapped face, on its surface, between the nodes of its edges.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/face_surface.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/lattice/grid_laplace.hpp>
#include <pavior/lattice/submap_lattice.hpp>
#include <pavior/smooth/surface_quads.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace pavior {

/// A meshed face with its lattice. Node n of the grid is node n of FaceMesh.
struct SubmapFace {
    LogicalGrid<2> grid;
    FaceTrace trace;
    std::size_t folded_harmonic = 0;  ///< quads folded by the harmonic map in the parameter plane
    std::vector<Index> folded;        ///< quads folded in the end
};

namespace detail {

/// Visits the boundary nodes of a face: f(lattice point, loop, position in the use, use).
template <class F>
void for_each_boundary_node(const LogicalFace& face, const FaceTrace& trace, std::span<const int> edges, F&& f) {
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
        for (std::size_t i = 0; i < face.loops[l].uses.size(); ++i) {
            const LatticePoint<2> step = lattice_step(face.loops[l].heading[i]);
            const int n = edges[face.loops[l].uses[i].edge.index()];
            for (int k = 0; k < n; ++k) {
                f(LatticePoint<2>{trace[l][i][0] + k * step[0], trace[l][i][1] + k * step[1]}, l, i, k);
            }
        }
    }
}

/// The nodes of a face on its boundary: ids, parameters, and the layers of its lattice.
struct FaceBorder {
    std::vector<Index> nodes;  ///< per grid node; no_index inside
    std::vector<Vec2> uv;
    LatticeLayers<2> layers;
};

template <brep B>
[[nodiscard]] FaceBorder face_border(const B& b, const BoundaryMesh& mesh, FaceId f, const LogicalFace& face,
                                     std::span<const int> edges, const SubmapFace& lattice) {
    FaceBorder border{std::vector<Index>(lattice.grid.node_count(), no_index),
                      std::vector<Vec2>(lattice.grid.node_count(), Vec2::Zero()),
                      {}};
    const Periods periods = b.face_period(f);
    LayerWidths<2> widths(lattice.grid);
    std::array<std::set<int>, 2> planes;
    std::vector<ChainNodes> chains;
    for (const LogicalLoop& loop : face.loops) {
        chains.push_back(chain_nodes(b, mesh, loop.uses, f, true));
        unwrap_chain(chains.back().uv, periods);
        if (chains.size() > 1) {
            const std::span<const Vec2> outer(chains[0].uv.data(), chains[0].uv.size() - 1);
            const Vec2 shift = inside_shift(chains.back().uv.front(), outer, periods);
            for (Vec2& uv : chains.back().uv) {
                uv += shift;
            }
        }
    }
    std::size_t at = 0, last = 0;
    for_each_boundary_node(
        face, lattice.trace, edges, [&](const LatticePoint<2>& p, std::size_t l, std::size_t i, int k) {
            at = l == last ? at : 0;
            last = l;
            const int heading = face.loops[l].heading[i];
            const std::size_t axis = heading % 2 == 0 ? 0 : 1;
            const double length = (mesh.nodes[chains[l].nodes[at + 1]] - mesh.nodes[chains[l].nodes[at]]).norm();
            widths.add(axis, heading < 2 ? p[axis] : p[axis] - 1, length);
            const Index node = lattice.grid.node(p);
            border.nodes[node] = chains[l].nodes[at];
            border.uv[node] = chains[l].uv[at];
            if (k == 0) {
                planes[0].insert(p[0]);
                planes[1].insert(p[1]);
            }
            ++at;
        });
    border.layers.width = widths.take();
    for (std::size_t a = 0; a < 2; ++a) {
        border.layers.planes[a].assign(planes[a].begin(), planes[a].end());
    }
    return border;
}

[[nodiscard]] PAVIOR_INLINE std::vector<QuadCorners> lattice_quads(const LogicalGrid<2>& grid);

/// Moves the inner nodes where the harmonic map in space, projected, folds less, then untangles.
template <brep B>
void repair_face(const B& b, FaceId f, const FaceBorder& border, std::span<const QuadCorners> quads,
                 std::vector<Vec3>& points, std::vector<Vec2>& uv, SubmapFace& result) {
    const FaceSurface<B> surface{&b, f};
    const auto evaluate = [&](const std::vector<Vec2>& at) {
        std::vector<Vec3> x = points;
        for (std::size_t n = 0; n < at.size(); ++n) {
            x[n] = border.nodes[n] == no_index ? surface.point(at[n]) : points[n];
        }
        return x;
    };
    const auto keep_if_better = [&](std::vector<Vec2> other) {
        const std::vector<Vec3> x = evaluate(other);
        const std::vector<Index> folded = folded_surface_quads(surface, std::span<const Vec3>(x), other, quads);
        if (folded.size() < result.folded.size()) {
            result.folded = folded;
            points = x;
            uv = std::move(other);
        }
    };
    std::vector<Vec3> in_space = points;
    place_inner_nodes(result.grid, border.layers, in_space);
    std::vector<Vec2> closest = uv;
    for (std::size_t n = 0; n < closest.size(); ++n) {
        if (border.nodes[n] == no_index) {
            closest[n] = surface.closest(in_space[n]);
            closest[n] += nearest_image_shift(closest[n], uv[n], b.face_period(f));
        }
    }
    keep_if_better(std::move(closest));
    if (!result.folded.empty()) {
        std::vector<std::uint8_t> fixed;
        for (const Index node : border.nodes) {
            fixed.push_back(node == no_index ? 0 : 1);
        }
        std::vector<Vec2> other = uv;
        (void)untangle_surface_quads(surface, std::span<Vec2>(other), quads, std::span<const std::uint8_t>(fixed), {},
                                     std::span<const Vec3>(in_space));
        keep_if_better(std::move(other));
    }
}

}  // namespace detail

/// Meshes face \p f, whose logical shape is \p face: nodes inside are placed by a harmonic map in the parameter plane
/// (place_inner_nodes()); with \p repair, if that folds quads, by the one in space and the closest points, then by
/// untangling on the surface. Every inner node has four quads. Fills mesh.faces[f]; nodes in the order of the lattice
/// (s fastest), so that a face that is one rectangle is structured() as a linking side is. All edges of the face must
/// be meshed with the numbers given.
/// \throws InputError infeasible_intervals if the numbers do not close or the face overlaps itself.
template <brep B>
SubmapFace mesh_submap_face(const B& b, BoundaryMesh& mesh, FaceId f, const LogicalFace& face,
                            const SubmapNumbers& numbers, bool repair = true) {
    FaceTrace trace = trace_face(face, numbers.edges, numbers.links[f.index()]);
    SubmapFace result{LogicalGrid<2>(trace_facets(face, trace, numbers.edges)), std::move(trace), 0, {}};
    if (!result.grid.ok()) {
        const int tag = b.tag(2, f.index());
        throw InputError(ErrorCode::infeasible_intervals,
                         "the numbers of intervals make face " + std::to_string(tag) + " overlap itself", {tag});
    }
    detail::FaceBorder border = detail::face_border(b, mesh, f, face, numbers.edges, result);
    std::vector<Vec2> uv = border.uv;
    place_inner_nodes(result.grid, border.layers, uv);
    std::vector<Vec3> points(uv.size());
    for (std::size_t n = 0; n < uv.size(); ++n) {
        points[n] = border.nodes[n] == no_index ? Vec3(b.face_point(f, uv[n])) : mesh.nodes[border.nodes[n]];
    }
    FaceMesh& target = mesh.faces[f.index()];
    target.quads = detail::lattice_quads(result.grid);
    result.folded = folded_surface_quads(FaceSurface<B>{&b, f}, std::span<const Vec3>(points), uv,
                                         std::span<const QuadCorners>(target.quads));
    result.folded_harmonic = result.folded.size();
    if (repair && !result.folded.empty()) {
        detail::repair_face(b, f, border, target.quads, points, uv, result);
    }
    target.nodes = border.nodes;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (target.nodes[n] == no_index) {
            target.nodes[n] = mesh.add_node(points[n]);
        }
    }
    target.uv = std::move(uv);
    const auto columns = static_cast<std::size_t>(result.grid.high()[0] - result.grid.low()[0]);
    const auto rows = static_cast<std::size_t>(result.grid.high()[1] - result.grid.low()[1]);
    if (result.grid.cell_count() == columns * rows) {
        target.columns = static_cast<int>(columns);
        target.rows = static_cast<int>(rows);
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/submap_face-inl.hpp>
#endif
