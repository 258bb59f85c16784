#pragma once
// The names in a STEP file, read from its text: Gmsh's labels join them with slashes and leave out those of faces.
// Internal to the cad component.

#include <pavior/math/point.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pavior::detail {

/// A face in a shell, with what can be compared to a face of the CAD kernel.
struct StepFace {
    std::string name;
    std::vector<Vec3> vertices;  ///< each once
};

/// A solid where the product structure puts it.
struct StepSolid {
    std::string name;      ///< of the product, or of the solid; see read_step_solids()
    std::string product;   ///< as it stands in the file, escapes and all
    bool surface = false;  ///< faces alone: what becomes of them is the kernel's choice
    bool placed = false;   ///< by an assembly: its vertices are not where they say
    std::vector<StepFace> faces;
    std::vector<Vec3> vertices;  ///< each once
};

/// A string of ISO 10303-21 without quotes around it, as UTF-8: '' \\ \S\ \P.\ \X\ \X2\ \X4\ read, control characters
/// left out, bytes that are not UTF-8 taken for Latin-1.
[[nodiscard]] std::string step_string(std::string_view text);

/// The solids of a STEP file as the products and their assemblies name them, parts that are used twice twice. A solid
/// has the name of its product if that is its only one, else its own where there is one. Names that only say which
/// program wrote the file ("Open CASCADE ...", "NONE") are none. Where there is no solid, surface models stand for
/// solids. What cannot be read has no name; nothing is thrown.
[[nodiscard]] std::vector<StepSolid> read_step_solids(std::string_view text);

}  // namespace pavior::detail
