#pragma once
/// \file
/// Files as tetrahedra to block; of the compiled part pavior::part.

#include <pavior/core/progress.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/part/kernels.hpp>

#include <filesystem>

namespace pavior {

/// Reads a closed surface (.stl .obj .off .ply), the solids of a CAD model (.step .stp .iges .igs .brep) or tetrahedra
/// with features (.vtk .vtu .msh), and makes the reference mesh, its features by \p features.
/// \param size  of the hexahedra that the blocks are to be filled with, so that triangles follow curved faces as
///              closely as they need it; 0: blocks alone. NOT thread-safe for CAD models (see GmshBrep). Deterministic.
/// \throws FileError, InputError for what cannot be read or is no closed surface; Error(cad_failure, tetrahedra_failed)
[[nodiscard]] BlockReference read_block_reference(const std::filesystem::path& file, double size = 0,
                                                  const FeatureOptions& features = {}, const Progress& progress = {});

}  // namespace pavior
