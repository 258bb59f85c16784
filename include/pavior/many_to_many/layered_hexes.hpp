#pragma once
/// \file
/// Hexahedra in columns over the quads of an arrangement: layer by layer between the levels of the caps.

#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <vector>

namespace pavior {

/// Hexahedra of a body with their entities. Nodes are numbered level by level in the order of the plane mesh,
/// hexahedra layer by layer in the order of its quads.
struct LayeredHexes {
    HexMesh mesh;
    std::vector<Index> hex_solid;
    std::vector<QuadCorners> quads;   ///< of caps and sides, seen from outside of the solid quad_solid
    std::vector<Index> quad_surface;  ///< cap, or number of caps + side; no_index: a side that the body does not name
    std::vector<Index> quad_solid;  ///< the solid behind; between two solids the one below, or on the left of the edge
};

}  // namespace pavior
