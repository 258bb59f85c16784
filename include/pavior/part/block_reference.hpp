#pragma once
/// \file
/// Files as tetrahedra to block; of the compiled part pavior::part.

#include <pavior/core/progress.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/part/kernels.hpp>

#include <filesystem>
#include <stop_token>

namespace pavior {

/// How read_block_reference() works.
struct ReferenceOptions {
    /// Of the hexahedra that the blocks are to be filled with, so that triangles follow curved faces as closely as they
    /// need it; 0: blocks alone.
    double size = 0;
    FeatureOptions features = {};
    double max_hexahedra = 0;   ///< as PartOptions::max_hexahedra
    double seconds = 0;         ///< limit for the CAD kernel, and for each run of a tetrahedralizer; 0: 300 and 600
    std::stop_token stop = {};  ///< ends the call by Stopped
    Progress progress = {};
};

/// Reads a closed surface (.stl .obj .off .ply), the solids of a CAD model (.step .stp .iges .igs .brep) or tetrahedra
/// with features (.vtk .vtu .msh), and makes the reference mesh. NOT thread-safe for CAD models (see GmshBrep).
/// Deterministic.
/// \throws FileError, InputError for what cannot be read or is no closed surface, bad_option for too many hexahedra;
/// Error(cad_failure, tetrahedra_failed); Stopped
[[nodiscard]] BlockReference read_block_reference(const std::filesystem::path& file,
                                                  const ReferenceOptions& options = {});

}  // namespace pavior
