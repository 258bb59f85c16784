#pragma once
/// \file
/// Cells untangled and optimised.

#include <pavior/smooth/hexes.hpp>          // hexahedra, boundary fixed
#include <pavior/smooth/improve_hexes.hpp>  // hexahedra, the worst first, boundary nodes fixed or sliding
#include <pavior/smooth/node_guide.hpp>     // what holds a node: a surface, a curve or a place
#include <pavior/smooth/pillow.hpp>         // a layer of hexahedra under quads of the boundary
#include <pavior/smooth/quads.hpp>          // quads in a plane, boundary fixed
#include <pavior/smooth/surface_quads.hpp>  // quads on a parametric surface, boundary fixed
