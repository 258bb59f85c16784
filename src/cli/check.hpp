#pragma once

#include "../report/report_json.hpp"
#include "commands.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/part/cad_deviation.hpp>

#include <functional>
#include <iosfwd>
#include <optional>

namespace pavior::cli {

/// The format of the mesh that was written to \p output, if one was.
[[nodiscard]] std::optional<MeshFormat> written_format(const std::string& output, MeshFormat wish, bool written);

/// Table of counts, conformity and groups, and a histogram a metric.
void print_check(std::ostream& out, const HexMeshData& data, const MeshCheck& check);

/// "12 hexahedra, 34 nodes"
[[nodiscard]] std::string counts_of(const MeshCheck& check);

/// "...: 12 hexahedra, 34 nodes; scaled Jacobian min 0.5, mean 0.9; volume ...; 1.2 s"
void print_summary(const std::string& file, const std::string& counts, const MeshCheck& check,
                   const std::optional<CadDeviation>& deviation, double seconds);

/// What is wrong with a mesh, and whether it was written all the same.
void print_invalid(const std::string& what, const std::string& faults, bool written);

/// Adds \p more to the end of \p warnings.
void append(std::vector<std::string>& warnings, std::vector<std::string> more);

void print_warnings(const std::vector<std::string>& warnings);

/// For Guard::set_limit(): writes a report that says that time was over.
[[nodiscard]] std::function<void()> late_report(const MakeCommand& command);

/// How to read a CAD file in the time that is left.
[[nodiscard]] CadOptions cad_options(const MakeCommand& command, const Guard& guard);

/// {"edge": {"12": 0.5}, ...}, without what is empty.
[[nodiscard]] nlohmann::json lengths_json(const LocalLengths& lengths);

}  // namespace pavior::cli
