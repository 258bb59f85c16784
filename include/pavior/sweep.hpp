#pragma once
/// \file
/// One-to-one sweeps between two meshed caps, without CAD (chapter 4 \cite roca2009 ).

#include <pavior/sweep/inner_layers.hpp>       // inner nodes alone, level by level
#include <pavior/sweep/linking_side.hpp>       // structured meshes of linking sides
#include <pavior/sweep/problem.hpp>            // the input: two caps and the loops of all levels
#include <pavior/sweep/report.hpp>             // what a sweep reports besides its nodes
#include <pavior/sweep/ribs.hpp>               // nodes on the ribs that follow each other
#include <pavior/sweep/spacing.hpp>            // positions of levels in [0, 1]
#include <pavior/sweep/sweep.hpp>              // hexahedra between two caps: in one call, on demand, or streamed
#include <pavior/sweep/sweep_mesh.hpp>         // stored nodes, implicit hexahedra
#include <pavior/sweep/target_projection.hpp>  // the mesh of the target cap
#include <pavior/sweep/transfinite.hpp>        // a structured grid from its four sides
#include <pavior/sweep/untangle_sweep.hpp>     // repairs inverted hexahedra
#include <pavior/sweep/verify_problem.hpp>     // is this a sweep?
