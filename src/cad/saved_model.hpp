#pragma once
// Models as files of OpenCASCADE's own. Internal to the cad component.

#include "gmsh_topology.hpp"

#include <filesystem>

namespace pavior::detail {

/// Writes the current model to a file of OpenCASCADE's own, which keeps what solids share, and reads it back. False if
/// what comes back is not the same.
bool save_model(const std::filesystem::path& file, const Topology& topology);

}  // namespace pavior::detail
