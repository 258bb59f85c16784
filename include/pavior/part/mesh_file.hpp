#pragma once
/// \file
/// From a CAD file to hexahedra; the compiled part pavior::part.

#include <pavior/part/part_mesh.hpp>
#include <pavior/part/part_options.hpp>

#include <filesystem>

namespace pavior {

class GmshBrep;

/// mesh_part() of the solids of a .step, .stp, .iges, .igs or .brep file with the kernels of pavior::cad, glpk, tetra
/// and imprint. Each try runs in a process of its own, which is ended at its limit of time and when a stop is requested
/// (then Stopped is thrown), so that neither a crash nor an endless loop of foreign code reaches the caller. Reading
/// takes place in such a process first, too.
/// One call at a time meshes, others wait: CAD models live in Gmsh, which keeps one state for all threads. Whatever
/// else uses Gmsh (pavior::cad, your own code) must not run meanwhile. POSIX alone (fork).
/// MethodTry::report is a JSON object: the method's own reports, "mesh" (counts, faults, quality, groups),
/// "cad_volume".
/// Overlaps and gaps of solids are told in PartMesh::warnings.
/// \throws FileError for what cannot be read; UnmeshableError cad_failure for slices (refuse_slices()) unless
/// PartOptions::allow_slices; InputError bad_option; Stopped
[[nodiscard]] PartMesh mesh_file(const std::filesystem::path& file, const PartOptions& options = {});

/// The same for a model that is there already. The caller sees to it that nothing else uses Gmsh meanwhile.
[[nodiscard]] PartMesh mesh_model(const GmshBrep& model, const PartOptions& options = {});

}  // namespace pavior
