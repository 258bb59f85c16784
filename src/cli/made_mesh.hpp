#pragma once

#include "check.hpp"
#include "commands.hpp"
#include "output_files.hpp"
#include "output_unit.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pavior::cli {

/// A mesh that a command has made, and what is said of it.
struct MadeMesh {
    HexMeshData data;
    MeshCheck check;
    bool valid = false;
    std::optional<CadDeviation> deviation;
    nlohmann::json json = nlohmann::json::object();  ///< of the report: what the command adds to it
    std::vector<std::string> warnings;
    std::string counts;                ///< for the summary
    std::string what = "the mesh is";  ///< "... not valid"
    std::string faults;                ///< if it is not
};

/// Writes the mesh if it may be written and the report, all or nothing, and says how it went.
[[nodiscard]] ExitCode deliver(const MakeCommand& command, const OutputUnit& unit, MadeMesh made, double seconds,
                               OutputFiles& files);

}  // namespace pavior::cli
