#pragma once
/// \file
/// All-quad meshes of plane regions between given boundary nodes.

#include <pavior/many_to_many/plane_region.hpp>

namespace pavior {

struct RegionOptions {
    /// Edge length of quads away from the boundary. 0: as the boundary nodes are spaced.
    double size = 0;
    /// Regions with one loop and four corners whose opposite sides have equally many nodes get a regular grid.
    bool structured = true;
};

/// Fills \p region with quads between its points, which come back first, bit by bit. A region with four corners and
/// matching sides becomes a grid; any other is triangulated by Gmsh and recombined, in several ways until the worst
/// corner is good, and triangulated and cut into quads where that is better; inner nodes are then optimised.
/// Deterministic. Not thread-safe (Gmsh). About 0.2 ms a quad where Gmsh recombines, 0.01 ms in a grid.
/// \throws InputError size_mismatch (an odd number of points), empty_input (a loop of fewer than three points, fewer
/// than four points), not_finite, bad_orientation (the outer loop does not run counter-clockwise), bad_option (size);
/// Error(cad_failure) where nothing leads to quads that are not folded
[[nodiscard]] PlaneQuadMesh mesh_region(const PlaneRegion& region, const RegionOptions& options = {});

/// mesh_region() as a region_mesher.
struct GmshRegionMesher {
    RegionOptions options = {};

    [[nodiscard]] PlaneQuadMesh operator()(const PlaneRegion& region) const { return mesh_region(region, options); }
};

static_assert(region_mesher<GmshRegionMesher>);

}  // namespace pavior
