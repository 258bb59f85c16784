#pragma once
/// \file
/// Units of length: what a CAD file says, and factors between them.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pavior {

/// So many millimetres is one of: um, mm, cm, dm, m, km, mil, inch (in), foot (ft), yard (yd), mile (mi); nothing for
/// other names.
[[nodiscard]] std::optional<double> millimetres(std::string_view unit);

/// The unit of length that a .step, .stp, .iges or .igs file says its geometry is in, by the names of millimetres();
/// "unknown" where it says none, or one that is not among these, and for other files. Models that are read from such
/// files are in millimetres whatever it is: OpenCASCADE converts them. O(size of the file).
/// \throws FileError if it cannot be read
[[nodiscard]] std::string unit_of_file(const std::filesystem::path& file);

}  // namespace pavior
