#pragma once
/// \file
/// A model to hexahedra, each solid by the method that suits it. Files: part/mesh_file.hpp of pavior::part.

#include <pavior/part/any_model.hpp>           // any brep behind one type
#include <pavior/part/cad_deviation.hpp>       // how far a mesh is from its CAD model
#include <pavior/part/kernels.hpp>             // the machines of others that mesh_part() takes, in one bundle
#include <pavior/part/mesh_part.hpp>           // the door: hexahedra for all solids of a model
#include <pavior/part/mixed_model.hpp>         // some swept, some submapped, beside meshes that are there
#include <pavior/part/mixed_solids.hpp>        // each solid by its own method, conforming
#include <pavior/part/multi_sweep_solids.hpp>  // many-to-many sweeps of solids in one call
#include <pavior/part/part_mesh.hpp>           // what it returns
#include <pavior/part/part_options.hpp>        // what may be asked
#include <pavior/part/pillow_solids.hpp>       // layers of hexahedra under faces that meet smoothly
#include <pavior/part/settle_nodes.hpp>        // nodes moved onto the vertices, edges and faces of the model
#include <pavior/part/solid_methods.hpp>       // which method meshes which solid
#include <pavior/part/split_solids.hpp>        // the last resort: tetrahedra, each split in four
#include <pavior/part/sweep_groups.hpp>        // which many-to-many sweeps share a direction, and their order
#include <pavior/part/sweep_solids.hpp>        // one-to-one sweeps of solids in one call
#include <pavior/part/try_method.hpp>          // one method on some solids
