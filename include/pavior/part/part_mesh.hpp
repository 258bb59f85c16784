#pragma once
/// \file
/// What mesh_part() and mesh_file() return.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/method_try.hpp>

#include <algorithm>
#include <iosfwd>
#include <string>
#include <vector>

namespace pavior {

/// Hexahedra of a model, what they belong to, and how they came about.
struct PartMesh {
    /// All meshes that were taken. Group numbers of hexahedra are tags of solids, those of quads tags of faces; quads are
    /// the mesh of the faces, about the face's own normal (of blocks: seen from outside).
    HexMeshData data;
    std::vector<PartDecision> decisions;  ///< one for each group of solids that touch
    MeshCheck check;                      ///< of data
    double seconds = 0;

    /// Whether every solid has a mesh.
    [[nodiscard]] bool complete() const {
        return std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.taken.has_value(); });
    }
    /// Whether every solid has one that is valid, and all together are.
    [[nodiscard]] bool valid() const {
        return !decisions.empty() && check.valid() &&
               std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.valid(); });
    }
};

/// \throws InputError bad_option: sizes that are not positive (size may be 0), a time limit that is negative
PAVIOR_INLINE void check_options(const PartOptions& options);

/// Why there is no valid mesh: a line for each try on each group that has none; empty for a valid mesh.
[[nodiscard]] PAVIOR_INLINE std::string reason_of(const PartMesh& part);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/part_mesh-inl.hpp>
#endif
