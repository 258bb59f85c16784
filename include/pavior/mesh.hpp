#pragma once
/// \file
/// Meshes: how they are read, written, checked and judged. mesh/cgal_access.hpp, which needs CGAL, is not among them.

#include <pavior/mesh/append_mesh.hpp>     // several meshes in the arrays of one
#include <pavior/mesh/boundary_loops.hpp>  // the boundary loops of a quad mesh
#include <pavior/mesh/boundary_quads.hpp>  // the boundary of a hexahedral mesh
#include <pavior/mesh/builders.hpp>        // hexahedra written into a type of the user
#include <pavior/mesh/eigen_access.hpp>    // meshes kept as Eigen matrices
#include <pavior/mesh/grouped_mesh.hpp>    // hexahedra with groups of solids and faces
#include <pavior/mesh/mesh_access.hpp>     // the one adaptation point for foreign meshes
#include <pavior/mesh/mesh_check.hpp>      // is this a mesh, and how good is it?
#include <pavior/mesh/outward_quads.hpp>   // quads on hexahedra, turned outward
#include <pavior/mesh/quality.hpp>         // statistics and histograms of the quality of cells
#include <pavior/mesh/span_mesh.hpp>       // plain arrays as meshes
#include <pavior/mesh/tagged_mesh.hpp>     // surfaces and tetrahedra with tags
#include <pavior/mesh/verify_hexes.hpp>    // hexahedra: conforming, valid, closed
#include <pavior/mesh/verify_quads.hpp>    // quads: conforming, oriented, a disc with holes
#include <pavior/mesh/verify_tets.hpp>     // tetrahedra: conforming, positive
