#pragma once
/// \file
/// Local dual contributions as published (chapter 5 \cite roca2009 ), from layer faces to blocks.

#include <pavior/contributions/candidates.hpp>      // the 28 candidate polygons of a tetrahedron
#include <pavior/contributions/contributions.hpp>   // the contributions of all tetrahedra
#include <pavior/contributions/dual_blocks.hpp>     // blocks read off contributions and regions
#include <pavior/contributions/dual_surfaces.hpp>   // dual surfaces and regions, to look at
#include <pavior/contributions/matching_rules.hpp>  // which candidates become contributions
#include <pavior/contributions/regions.hpp>         // the regions that become nodes of blocks
#include <pavior/contributions/triangle_dual.hpp>   // the same in the plane: triangles to quadrilaterals
