#pragma once
/// \file
/// Structured meshes of regions that are unions of unit squares or cubes.

#include <pavior/lattice/grid_laplace.hpp>     // positions of inner nodes: discrete harmonic maps
#include <pavior/lattice/logical_grid.hpp>     // a region of the lattice from its boundary
#include <pavior/lattice/submap_face.hpp>      // structured quads of a face of a model
#include <pavior/lattice/submap_polygon.hpp>   // structured quads inside a polygon
#include <pavior/lattice/submap_topology.hpp>  // solids as unions of logical boxes
