#pragma once

#include "commands.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/one_to_one/sweep_solid.hpp>

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace pavior::cli {

/// A mesh as made, before it is checked.
struct Swept {
    HexMeshData data;
    nlohmann::json report = nlohmann::json::object();
    std::vector<std::string> warnings;
};

/// Sweeps a problem given as JSON.
[[nodiscard]] Swept sweep_problem_file(const SweepCommand& command, const Progress& progress);

/// Sweeps \p solids of a model one-to-one, one conforming mesh for all.
/// \throws UnmeshableError naming faces
[[nodiscard]] Swept sweep_cad_model(const GmshBrep& model, std::span<const SolidId> solids, const SweepCommand& command,
                                    const Progress& progress);

/// Sweeps the solids of a CAD file.
[[nodiscard]] Swept sweep_cad_file(const SweepCommand& command, const Progress& progress);

/// The options of a sweep that both have.
[[nodiscard]] inline SweepOptions sweep_options(const SweepCommand& command) {
    SweepOptions options;
    options.method = command.method;
    options.strategy = command.strategy;
    options.correction = command.correction;
    options.execution = Execution{command.threads};
    return options;
}

[[nodiscard]] nlohmann::json to_json(const SweepReport& report);
[[nodiscard]] nlohmann::json to_json(const SmoothReport& report);

}  // namespace pavior::cli
