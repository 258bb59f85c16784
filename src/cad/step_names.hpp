#pragma once
// Names of a STEP file for the entities of the Gmsh model that was read from it. Internal to the cad component.

#include "gmsh_import.hpp"

#include <string>

namespace pavior::detail {

/// Puts the names that the STEP file \p text gives to the solids and faces of the current model into \p names. Solids
/// are found by the ends of their labels, by what they look like and by their order; faces of a solid by their order in
/// its shell and by where their vertices are, unless several may be meant. A solid that is not found has the longest
/// name of a product that its label ends with. O(solids^2 + size of the file).
void name_step_entities(const std::string& text, EntityNames& names);

}  // namespace pavior::detail
