#pragma once

#include "../report/report_json.hpp"

#include <pavior/part/cad_deviation.hpp>

#include <iosfwd>
#include <optional>

namespace pavior::cli {

/// Table of counts, conformity and groups, and a histogram a metric.
void print_check(std::ostream& out, const HexMeshData& data, const MeshCheck& check);

/// "12 hexahedra, 34 nodes"
[[nodiscard]] std::string counts_of(const MeshCheck& check);

/// "...: 12 hexahedra, 34 nodes; scaled Jacobian min 0.5, mean 0.9; volume ...; 1.2 s"
void print_summary(const std::string& file, const std::string& counts, const MeshCheck& check,
                   const std::optional<CadDeviation>& deviation, double seconds);

/// What is wrong with a mesh, and whether it was written all the same.
void print_invalid(const std::string& what, const std::string& faults, bool written);

void print_warnings(const std::vector<std::string>& warnings);

}  // namespace pavior::cli
