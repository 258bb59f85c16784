#pragma once
/// \file
/// Sweeps of solids with caps at any number of levels: straight, round an axis or along a path.

#include <pavior/many_to_many/extruded_body.hpp>      // what is swept, as plain data
#include <pavior/many_to_many/extrusion.hpp>          // directions in which a solid is an extrusion
#include <pavior/many_to_many/multi_sweep.hpp>        // hexahedra of an extruded body
#include <pavior/many_to_many/multi_sweep_model.hpp>  // hexahedra of the solids of a CAD model
#include <pavior/many_to_many/plane_arrangement.hpp>  // curves in a plane cut by each other
#include <pavior/many_to_many/plane_region.hpp>       // a region of the plane and the quads that fill it
#include <pavior/many_to_many/polygon_body.hpp>       // a body from polygons at levels, without CAD
#include <pavior/many_to_many/revolution.hpp>         // models swept round an axis
#include <pavior/many_to_many/sweep_paths.hpp>        // paths found from the edges of a solid
