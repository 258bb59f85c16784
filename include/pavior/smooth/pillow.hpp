#pragma once
/// \file
/// Pillowing: a layer of hexahedra inserted under quads of the boundary.

#include <pavior/core/compiled.hpp>
#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/outward_quads.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace pavior {

/// Why there is no layer.
enum class PillowFault : std::uint8_t {
    none,           ///< there is one
    open_rim,       ///< its rim would end inside: hexahedra of the set and others share a quad there that is not chosen
    foreign_rim,    ///< it would leave through the face of another group of hexahedra, or part groups that touch
    split_feature,  ///< several lines between groups of quads leave the rim at one node, which can follow only one
    pinched,        ///< two parts of the layer touch at a node or an edge
};

/// The stable name of \p fault, as written here.
[[nodiscard]] constexpr std::string_view to_string(PillowFault fault) noexcept {
    switch (fault) {
        case PillowFault::none: return "none";
        case PillowFault::open_rim: return "open_rim";
        case PillowFault::foreign_rim: return "foreign_rim";
        case PillowFault::split_feature: return "split_feature";
        case PillowFault::pinched: return "pinched";
    }
    return "unknown";
}

struct PillowOptions {
    /// Part of the mesh edges that go inward which the layer takes, in (0, 1); half of it where both ends are doubled.
    double fraction = 0.5;
    /// The hexahedra under the layer: others keep their nodes. A flag a hexahedron, not 0: in the set; empty: all.
    std::span<const char> shrink = {};
};

/// What was done, and what every new entity comes from.
struct PillowReport {
    PillowFault fault = PillowFault::none;
    std::vector<Index> fault_nodes;      ///< where, at most 16, ascending
    std::vector<Index> node_from;        ///< for each new node the one that it doubles
    std::vector<Index> hex_from;         ///< for each hexahedron of the layer the one under it
    std::vector<std::size_t> quad_from;  ///< for each new quad the one, not of the layer, that it continues
    std::size_t inverted = 0;            ///< hexahedra of the layer, and of those it moved, that are not positive

    [[nodiscard]] bool ok() const { return fault == PillowFault::none; }
};

/// A mesh with a layer; without one if that has a fault.
struct PillowedMesh {
    HexMeshData data;
    PillowReport report;
};

/// Inserts a layer of hexahedra under some of the quads of \p data, the dual of which is a sheet parallel to them
/// \cite mitchell1995. Nodes of the chosen quads stay where they are and get a double further in, which the hexahedra
/// of the shrink set take; one hexahedron a chosen quad fills the gap. At the rim of the chosen quads the sheet leaves
/// through the quads beside them: the rim stays where it is, doubles lie on mesh edges or quads of the neighbour, on
/// the line between two groups where one leaves the rim. Quads that end on a chosen one, those of the boundary and
/// those between solids, are continued through the layer by a strip of new quads of their group.
///
/// Old entities keep their places in the arrays; new nodes come in the order of those that they double, new hexahedra
/// in the order of the chosen quads in data.quads, in the group of the hexahedron under them, new quads by the chosen
/// quad and the quad that they continue, which they agree with in sense. A mesh that conforms still does.
///
/// Doubles lie on mesh edges, else on the diagonals of the quads or hexahedra between chosen quads, less far where
/// these meet at more than 90 degrees. Where a hexahedron would not be positive that was, and in the layer, they move
/// back, to 1/32 of the way at the last, then the same in the middle of the directions that count. On curved faces they
/// lie on chords: whoever knows the face can move them onto it (PillowReport::node_from) and improve_hexes() the rest.
///
/// \param data    hexahedra, quads on them and their groups, in and out; unchanged if the layer has a fault. Quads of
///                one group are one face; without quad_groups all are. Boundary quads that are not listed count as a
///                group of their own, and their strips are not listed.
/// \param chosen  positions in data.quads, in any order; repeated positions and quads on one face count once. A quad
///                between two hexahedra is chosen as that of the one in the shrink set.
/// \throws InputError bad_option (fraction), size_mismatch (shrink, groups), bad_index (positions or nodes out of
/// range; a chosen quad on no hexahedron of the set, or between two of it), non_manifold and bad_orientation as
/// boundary_quads()
/// O(n), O(q log q) in the quads and O(k log k) in the k hexahedra that touch chosen ones. One thread.
PAVIOR_INLINE PillowReport pillow(HexMeshData& data, std::span<const std::size_t> chosen,
                                  const PillowOptions& options = {});

/// The same for any hex_mesh with quads on it, which are copied.
/// \param quads,quad_groups  four node ids each, and a number each or nothing
template <hex_mesh M, class Quad>
[[nodiscard]] PillowedMesh pillow(const M& mesh, std::span<const Quad> quads, std::span<const std::int32_t> quad_groups,
                                  std::span<const std::size_t> chosen, const PillowOptions& options = {}) {
    PillowedMesh result;
    result.data.mesh = to_hex_mesh(mesh);
    for (const Quad& q : quads) {
        result.data.quads.push_back(
            {static_cast<Index>(q[0]), static_cast<Index>(q[1]), static_cast<Index>(q[2]), static_cast<Index>(q[3])});
    }
    result.data.quad_groups.assign(quad_groups.begin(), quad_groups.end());
    result.report = pillow(result.data, chosen, options);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/pillow-inl.hpp>
#endif
