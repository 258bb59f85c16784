#pragma once

#include "exit_code.hpp"

#include <pavior/affine/method.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/marking/marking.hpp>
#include <pavior/part/part_options.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/level_map.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior::cli {

/// Options of `pavior sweep`.
struct SweepCommand {
    std::string input, output;
    double size = 0;  ///< 0: a twelfth of the diagonal of the model
    std::map<int, double> edge_size, face_size, solid_size;
    double max_angle = 30;  ///< degrees
    double imprint_tolerance = 0;
    bool allow_slices = false;
    std::optional<int> layers;
    AffineMethod method = AffineMethod::constrained;
    SweepStrategy strategy = SweepStrategy::direct;
    BoundaryCorrection correction = BoundaryCorrection::idw;
    bool smooth = true;
    std::optional<int> source, target;  ///< tags of faces
    unsigned threads = 0;               ///< 0: one a core
    std::string unit;                   ///< of the mesh written; empty: that of the model
    std::string report;
    bool quiet = false;
    bool keep_invalid = false;
};

/// Options of `pavior block`.
struct BlockCommand {
    std::string input, output;
    double size = 0;        ///< 0: blocks only
    double max_angle = 30;  ///< degrees
    Marking marking = Marking::sheets;
    Propagation propagation = Propagation::full;
    Dualization dualization = Dualization::complex;
    double mu = 0.1;                     ///< where the dual surfaces are drawn
    std::vector<double> feature_angles;  ///< end below, corner above, reversal above; empty: the default
    std::string dual;
    unsigned threads = 0;  ///< 0: one a core
    std::string unit;      ///< of the mesh written; empty: that of the model
    std::string report;
    bool quiet = false;
    bool keep_invalid = false;
};

/// Options of `pavior mesh`.
struct MeshCommand {
    std::string input, output;
    double size = 0;        ///< 0: a twelfth of the diagonal of the model
    double max_angle = 30;  ///< degrees
    double imprint_tolerance = 0;
    bool allow_slices = false;
    std::optional<PartMethod> method;  ///< unset: each in turn
    double timeout = 60;               ///< seconds a solid; 0: no limit
    bool explain = false;
    unsigned threads = 0;  ///< 0: one a core
    std::string unit;      ///< of the mesh written; empty: that of the model
    std::string report;
    bool quiet = false;
    bool keep_invalid = false;
};

/// Options of `pavior quality`.
struct QualityCommand {
    std::string mesh;
    std::string report;
    unsigned threads = 0;
};

ExitCode run_mesh(const MeshCommand& command);
ExitCode run_sweep(const SweepCommand& command);
ExitCode run_block(const BlockCommand& command);
ExitCode run_quality(const QualityCommand& command);

}  // namespace pavior::cli
