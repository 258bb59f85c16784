#pragma once
/// \file
/// CAD models, whoever stores them: what is asked of one, and the mesh of its boundary.

#include <pavior/brep/boundary_mesh.hpp>       // the mesh of vertices, edges and faces, shared by solids
#include <pavior/brep/brep.hpp>                // the concept of a boundary representation
#include <pavior/brep/edge_mesh.hpp>           // nodes along edges
#include <pavior/brep/face_distance.hpp>       // how far boundary nodes are from their faces
#include <pavior/brep/face_surface.hpp>        // a face as a parametric surface
#include <pavior/brep/join_solids.hpp>         // a mesh that keeps its neighbours' nodes, joined to theirs
#include <pavior/brep/joined_faces.hpp>        // models in which faces that go on in each other are one
#include <pavior/brep/neighbour_boundary.hpp>  // what solids that are done leave to their neighbours
#include <pavior/brep/snap_to_faces.hpp>       // boundary nodes moved onto their faces
#include <pavior/brep/solid_boundary.hpp>      // the boundary of a solid as half-edges
#include <pavior/brep/touching_solids.hpp>     // solids that hang together
