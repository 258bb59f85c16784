#pragma once
/// \file
/// Coarse hexahedral blocks of a solid, and the fine mesh inside them.

#include <pavior/block/block_mesh.hpp>     // blocks that know their part of the reference mesh
#include <pavior/block/block_solid.hpp>    // from a reference mesh to blocks and their refinement in one call
#include <pavior/block/dualize.hpp>        // from a cell complex to blocks
#include <pavior/block/flip_tets.hpp>      // tetrahedra connected otherwise, so that their split is better
#include <pavior/block/place_blocks.hpp>   // coordinates for the nodes of blocks
#include <pavior/block/refine_blocks.hpp>  // the fine mesh inside the blocks, on the geometry
#include <pavior/block/split_tets.hpp>     // every tetrahedron as four hexahedra
#include <pavior/block/verify_blocks.hpp>  // are these blocks a valid mesh of the solid?
