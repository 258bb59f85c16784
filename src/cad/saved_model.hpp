#pragma once
// Models as files of OpenCASCADE's own. Internal to the cad component.

#include "gmsh_topology.hpp"

#include <cstddef>
#include <filesystem>
#include <map>

namespace pavior::detail {

/// Writes the current model to a file of OpenCASCADE's own, which keeps what solids share, and reads it back.
Topology save_model(const std::filesystem::path& file);

/// Whether two models are the same, tags included.
bool same_topology(const Topology& a, const Topology& b);

/// By tag of a solid of a copy: the position of the same solid in the original, by faces, volume and vertices.
std::map<int, std::size_t> match_solids(const Topology& copy, const Topology& original);

}  // namespace pavior::detail
