#pragma once
/// \file
/// Everything that is asked of hexahedra before they are handed out, in one call.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cstddef>

namespace pavior {

/// Faults, and quality where there are ids that can be read and any hexahedra.
struct MeshCheck {
    HexReport verify;
    HexQuality quality;
    std::size_t nodes = 0, hexahedra = 0;

    /// Conforming, and no hexahedron inverted.
    [[nodiscard]] bool valid() const { return verify.ok() && quality.inverted == 0; }
};

/// verify_hexes() and hex_quality() of \p mesh. O(n log n); the same for any number of threads.
[[nodiscard]] PAVIOR_INLINE MeshCheck check_mesh(const HexMesh& mesh, Execution execution = sequential);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/mesh_check-inl.hpp>
#endif
