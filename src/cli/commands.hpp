#pragma once

#include "exit_code.hpp"
#include "guard.hpp"

#include <pavior/affine/method.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/marking/marking.hpp>
#include <pavior/part/part_options.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/level_map.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pavior::cli {

/// What every command that makes a mesh takes.
struct MakeCommand {
    std::string input, output;
    MeshFormat format = MeshFormat::by_extension;
    double size = 0;  ///< 0: the command's default
    LocalLengths local;
    double max_angle = 30;          ///< degrees
    std::string unit;               ///< of the mesh written; empty: that of the model
    std::optional<double> timeout;  ///< seconds for the whole program; 0: no limit; unset: the command's default
    double max_hexahedra = 0;       ///< 0: no limit
    unsigned threads = 0;           ///< 0: one a core
    std::string report;
    bool quiet = false;
    bool keep_invalid = false;
};

/// What the commands that keep solids apart take.
struct SolidsCommand : MakeCommand {
    double imprint_tolerance = 0;
    bool allow_slices = false;
};

/// Options of `pavior sweep`.
struct SweepCommand : SolidsCommand {
    std::optional<int> layers;
    AffineMethod method = AffineMethod::constrained;
    SweepStrategy strategy = SweepStrategy::direct;
    BoundaryCorrection correction = BoundaryCorrection::idw;
    bool smooth = true;
    std::optional<int> source, target;  ///< tags of faces
};

/// Options of `pavior block`; size 0: blocks only.
struct BlockCommand : MakeCommand {
    Marking marking = Marking::sheets;
    Propagation propagation = Propagation::full;
    Dualization dualization = Dualization::complex;
    double mu = 0.1;                     ///< where the dual surfaces are drawn
    std::vector<double> feature_angles;  ///< end below, corner above, reversal above; empty: the default
    std::string dual;
};

/// Options of `pavior mesh`.
struct MeshCommand : SolidsCommand {
    std::optional<PartMethod> method;  ///< unset: each in turn
    bool last_resort = true, decompose = true;
    std::string save_pieces;
    bool explain = false;
};

/// Options of `pavior quality`.
struct QualityCommand {
    std::string mesh;
    std::string report;
    unsigned threads = 0;
};

ExitCode run_mesh(const MeshCommand& command, Guard& guard);
ExitCode run_sweep(const SweepCommand& command, Guard& guard);
ExitCode run_block(const BlockCommand& command, Guard& guard);
ExitCode run_quality(const QualityCommand& command);

}  // namespace pavior::cli
