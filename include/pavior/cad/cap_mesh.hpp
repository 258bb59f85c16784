#pragma once
/// \file
/// All-quad meshes of CAD faces between given boundary nodes.

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>

namespace pavior {

struct CapOptions {
    /// Edge length of quads away from the boundary, in the unit of the model. 0: as the boundary nodes are spaced.
    double size = 0;
    /// Faces with one loop and four corners whose opposite sides have equally many nodes get a regular grid.
    bool structured = true;
};

/// Fills \p face with quads between the nodes of \p boundary, which come back first, in their order and bit by bit; the
/// other nodes lie on the surface. Quads run counter-clockwise about the face's own normal, and no quad is folded.
///
/// The face is flattened by the mean metric of its parameters. A face with four corners and matching sides becomes a
/// grid (transfinite interpolation); any other is triangulated by Gmsh and recombined, in several ways until the worst
/// corner is good; where no way leads to quads alone, every second boundary node is meshed with triangles and each is
/// cut into three quads. Nodes are then optimised on the surface, the boundary held. A face with a seam
/// (CapBoundary::plane) is meshed in the plane of its loops, and nodes are moved to the face along its normal.
/// Deterministic: same input, same bytes. Not thread-safe (Gmsh). O(quads) memory; about 0.2 ms a quad where
/// Gmsh recombines, 0.01 ms in a grid.
/// \throws InputError size_mismatch (arrays of different length, an odd number of boundary nodes), empty_input (a loop
/// of fewer than three nodes, fewer than four nodes), not_finite, bad_option (size), bad_orientation (the outer loop
/// does not run counter-clockwise in u, v); Error(cad_failure) naming the face where nothing leads to quads that are
/// not folded.
[[nodiscard]] CapMesh mesh_cap(const GmshBrep& model, FaceId face, const CapBoundary& boundary,
                               const CapOptions& options = {});

/// mesh_cap() as a cap_mesher: a view of the model, which must outlive it.
struct GmshCapMesher {
    const GmshBrep* model;
    CapOptions options = {};

    [[nodiscard]] CapMesh operator()(FaceId face, const CapBoundary& boundary) const {
        return mesh_cap(*model, face, boundary, options);
    }
};

static_assert(cap_mesher<GmshCapMesher>);

}  // namespace pavior
