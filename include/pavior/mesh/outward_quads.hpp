#pragma once
/// \file
/// Quads on hexahedra: which hexahedra they are faces of, and turned so that they look outward.

#include <pavior/core/compiled.hpp>
#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/grouped_mesh.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// One face of a hexahedron.
struct HexFace {
    Index hex = no_index;  ///< no_index: none
    std::size_t face = 0;  ///< position in hex_faces

    friend bool operator==(const HexFace&, const HexFace&) = default;
};

/// For each of \p quads the first two faces of hexahedra with its nodes, in whatever order, by ascending hexahedron;
/// equal quads have equal faces. Quads whose nodes are not those of a face have none. O(hexahedra + quads log quads).
[[nodiscard]] PAVIOR_INLINE std::vector<std::array<HexFace, 2>> faces_under_quads(std::span<const HexCorners> hexes,
                                                                                  std::span<const QuadCorners> quads);

/// Turns the quads of \p data that look inward: each becomes counter-clockwise seen from outside of its hexahedron; with
/// hexahedra on both sides, seen from outside of the one whose group has the lower number. Quads between hexahedra of one
/// group, and those on none, stay as they are. A quad that is turned keeps its first node; the others keep their bytes.
/// O(hexahedra + quads log quads).
PAVIOR_INLINE void turn_quads_outward(HexMeshData& data);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/outward_quads-inl.hpp>
#endif
