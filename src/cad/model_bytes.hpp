#pragma once
// What a child process found out about a CAD file, as bytes for its parent. Internal to the cad component.

#include "gmsh_topology.hpp"

#include <pavior/cad/imprint_report.hpp>
#include <pavior/cad/triangulation.hpp>

#include <string>

namespace pavior::detail {

std::string to_bytes(const CadTriangulation& triangulation);
CadTriangulation triangulation_from_bytes(const std::string& bytes);

/// What topology and report say that cannot be read off the imprinted model itself: tags of the file, names, report.
std::string imprint_to_bytes(const Topology& topology, const ImprintReport& report);

/// Puts that into a topology with the same entities.
void imprint_from_bytes(const std::string& bytes, Topology& topology, ImprintReport& report);

}  // namespace pavior::detail
