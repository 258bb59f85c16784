#pragma once
/// \file
/// Tetrahedra of the solids of a CAD model, sized, with the tags of what they lie on.

#include <pavior/brep/solids_tets.hpp>
#include <pavior/cad/gmsh_brep.hpp>

#include <span>

namespace pavior {

/// Fills \p solids of \p model with Gmsh's tetrahedra, as SolidsTets; faces that other solids share with them do not
/// matter. TetSizes::variant 0, 1, 2 ...: triangles by Gmsh's frontal, Delaunay, adaptive mesher. In a child process
/// (fork), so that a crash or an endless loop becomes an error, and time is kept. Deterministic. NOT thread-safe (see
/// GmshBrep).
/// \throws Error(cad_failure) where Gmsh makes no tetrahedra, with its reason, or they do not end at the faces;
/// InputError bad_option (sizes), bad_index (of a solid); Stopped
[[nodiscard]] SolidsTets tetrahedra_of(const GmshBrep& model, std::span<const SolidId> solids, const TetSizes& sizes);

}  // namespace pavior
