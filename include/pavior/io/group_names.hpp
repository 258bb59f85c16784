#pragma once
/// \file
/// Names of groups as a mesh file may hold them.

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/grouped_mesh.hpp>

#include <vector>

namespace pavior {

/// The groups of \p data, solids first, then by number, each with the name that write_mesh() gives it in \p format:
///   all   no two groups bear one name, whatever their dimension: the first keeps it, others get _2, _3 ...; a group
///         whose own name is legal goes before one whose name becomes it. Control characters become spaces, bytes that
///         are not UTF-8 U+FFFD, and spaces at the ends go
///   .vtu  any other UTF-8
///   .vtk  at most 240 bytes with the escapes of VTK (%20 for a space), cut between characters
///   .msh  " becomes ' and \ becomes /, at most 200 bytes
///   .inp  letters, digits and underscores, a letter first, at most 80; names differ also in capitals. Other characters
///         become underscores, each one; a name without letters is VOLUME_ or SURFACE_ and its number
/// A group without a name keeps none, but in .inp; only there numbers of cells that are no group's are listed, too.
/// Depends on the groups alone, not on their order. \p format must not be by_extension. O(n log n).
[[nodiscard]] std::vector<MeshGroup> names_in_file(const HexMeshData& data, MeshFormat format);

}  // namespace pavior
