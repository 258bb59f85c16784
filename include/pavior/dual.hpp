#pragma once
/// \file
/// Tetrahedra with features, their layers of faces, and the cells between these.

#include <pavior/dual/boundary_surface.hpp>  // the boundary of tetrahedra and its dihedral angles
#include <pavior/dual/cell_complex.hpp>      // the cells that layer faces cut a solid into
#include <pavior/dual/classify.hpp>          // classes of faces, edges and nodes
#include <pavior/dual/copy_reference.hpp>    // any classified tetrahedral mesh as a reference mesh
#include <pavior/dual/dual_report.hpp>       // what keeps a dual from giving valid blocks
#include <pavior/dual/features.hpp>          // feature curves and vertices, and the reference mesh
#include <pavior/dual/reference_mesh.hpp>    // tetrahedra that know their features and layers
#include <pavior/dual/verify_dual.hpp>       // does this marking give valid blocks?
