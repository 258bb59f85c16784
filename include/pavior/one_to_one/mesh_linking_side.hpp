#pragma once
/// \file
/// Structured mesh of one linking side of a CAD model, on its surface, between the nodes of its edges.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/face_surface.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/lattice/submap_face.hpp>
#include <pavior/one_to_one/side_grid.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>
#include <pavior/sweep/linking_side.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// One logical side as positions and continuous parameters.
struct SideChain {
    std::vector<Index> ids;
    std::vector<Vec3> points;
    std::vector<Vec2> uv;
};

template <brep B>
[[nodiscard]] SideChain side_chain(const B& b, const BoundaryMesh& mesh, const EdgeChain& chain, FaceId face,
                                   bool along) {
    ChainNodes nodes = chain_nodes(b, mesh, chain, face, along);
    SideChain result{std::move(nodes.nodes), {}, std::move(nodes.uv)};
    for (const Index id : result.ids) {
        result.points.push_back(mesh.nodes[id]);
    }
    unwrap_chain(result.uv, b.face_period(face));
    return result;
}

/// Global node ids of the grid: border from the chains, inner nodes added row by row.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> grid_ids(BoundaryMesh& mesh, const StructuredGrid<Vec3>& grid,
                                                        const SideChain& bottom, const SideChain& right,
                                                        const SideChain& top, const SideChain& left);

}  // namespace detail

/// What became of one linking side.
struct LinkingFaceReport {
    FaceId face;
    LinkingWay way = LinkingWay::parameter;
    std::size_t folded_parameter = 0;  ///< quads folded by the plain map in the parameter plane
    std::vector<Index> folded;         ///< quads still folded
};

namespace detail {

/// The face of \p side as submapping sees it: from inside or outside, as the face's own normal points.
[[nodiscard]] PAVIOR_INLINE LogicalFace logical_face(const LinkingSide& side);

/// A side that is a union of rectangles, by mesh_submap_face().
template <brep B>
LinkingFaceReport mesh_lattice_side(const B& b, BoundaryMesh& mesh, const LinkingSide& side, bool repair) {
    SubmapNumbers numbers;
    for (const EdgeNodes& edge : mesh.edges) {
        numbers.edges.push_back(static_cast<int>(edge.nodes.size()) - 1);
    }
    numbers.links.resize(mesh.faces.size());
    const SubmapFace made = mesh_submap_face(b, mesh, side.face, logical_face(side), numbers, repair);
    return {side.face, LinkingWay::lattice, made.folded_harmonic, made.folded};
}

}  // namespace detail

/// Meshes the face of \p side: transfinite interpolation of the nodes of its edges in the parameter plane; with
/// \p repair closest points and untangling where that folds (linking_side()). Fills mesh.faces[face] with a structured
/// mesh whose rows run along the bottom. A side that is a union of rectangles is submapped (mesh_submap_face()). All
/// edges of the side must be meshed, opposite sides with equal numbers.
/// \throws InputError size_mismatch or inconsistent_boundary if they are not, infeasible_intervals if a union of
/// rectangles overlaps itself; what the model throws
template <brep B>
LinkingFaceReport mesh_linking_side(const B& b, BoundaryMesh& mesh, const LinkingSide& side, bool repair) {
    if (!side.rectangle()) {
        return detail::mesh_lattice_side(b, mesh, side, repair);
    }
    const FaceId f = side.face;
    const detail::SideChain bottom = detail::side_chain(b, mesh, side.bottom, f, side.outward);
    detail::SideChain right = detail::side_chain(b, mesh, side.right, f, side.outward);
    detail::SideChain top = detail::side_chain(b, mesh, side.top, f, !side.outward);
    detail::SideChain left = detail::side_chain(b, mesh, side.left, f, !side.outward);
    std::vector<Vec2> bottom_uv = bottom.uv;
    unwrap_sides(bottom_uv, top.uv, left.uv, right.uv, b.face_period(f), 0.0);

    LinkingSideOptions options;
    options.repair = repair;
    options.periods = b.face_period(f);
    options.uv_corner_tolerance = 1e-4;
    const FaceSurface<B> surface{&b, f};
    const LinkingSideMesh grid =
        linking_side(surface, GridSides<Vec3>{bottom.points, top.points, left.points, right.points},
                     GridSides<Vec2>{bottom_uv, top.uv, left.uv, right.uv}, options,
                     [&](const Vec3& x) { return surface.closest(x); });

    FaceMesh& face = mesh.faces[f.index()];
    face.columns = static_cast<int>(grid.nodes.columns);
    face.rows = static_cast<int>(grid.nodes.rows);
    face.nodes = detail::grid_ids(mesh, grid.nodes, bottom, right, top, left);
    face.uv = grid.uv.nodes;
    face.quads = side_quads(side, grid.nodes.columns, grid.nodes.rows);
    return {f, grid.way, grid.folded_parameter.size(), grid.folded};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/mesh_linking_side-inl.hpp>
#endif
