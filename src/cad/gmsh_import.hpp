#pragma once
// Reading CAD files into Gmsh, safely. Internal to the cad component.

#include "file_tags.hpp"
#include "gmsh_model.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <utility>

namespace pavior::detail {

/// Names of faces and solids by {dim, tag}.
using EntityNames = std::map<std::pair<int, int>, std::string>;

/// "step", "iges" or "brep" by the ending of \p file; empty for any other.
std::string cad_format(const std::filesystem::path& file);

/// FileError unless \p file is a regular, readable, non-empty file with one of the known endings.
void check_cad_file(const std::filesystem::path& file);

/// Puts the solids of \p file into the current Gmsh model. FileError if it holds none.
void import_file(const std::filesystem::path& file);

/// Runs \p task, which reads \p file, in a child process, reports what goes wrong there and hands over what it returns.
/// \throws FileError; Error cad_failure after so many seconds (0: no limit); Stopped
std::string try_reading(const std::filesystem::path& file, const std::function<std::string()>& task, double seconds,
                        const std::stop_token& stop);

/// Intersects the solids of \p model; what is closer than \p tolerance counts as touching. \p populate fills another
/// model in the same way, for the names of the faces; \p file is where they come from, if they do. Returns the names
/// after the operation; \p pieces, if any, gets what became of the solids.
EntityNames imprint_solids(const GmshModel& model, const std::function<void()>& populate,
                           const std::filesystem::path& file, double tolerance = 0, SolidPieces* pieces = nullptr);

/// The names of the current model.
EntityNames read_names();

/// The same with those that the STEP file \p file says and Gmsh does not; \p file may be any or none.
EntityNames read_names(const std::filesystem::path& file);

}  // namespace pavior::detail
