#pragma once
/// \file
/// Repair of corners that do not have three chains: a sheet through two of more, one that crosses between fewer.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/repair_sheet.hpp>

#include <optional>

namespace pavior {

/// The sheet that splits the worst corner (most chains, then smallest vertex) among those with more than three; none if
/// no pair of chains of any spans a plane that leaves the others on its two sides. Planes that pass through many
/// hexahedron vertices and few near misses win, then those far from the other chains, then those near to many vertices.
/// If there are only corners with one or two chains, a plane across the one, or halfway between the two, at
/// the first of them.
/// \p tolerance and \p size are lengths: of what counts as on the plane, and of the solid.
[[nodiscard]] PAVIOR_INLINE std::optional<RepairSheet> repair_corner(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                                     double tolerance, double size);

namespace detail {

/// The tetrahedra of a corner and its chains in cyclic order.
struct CornerRing {
    Index node = no_index;
    std::vector<Index> tets;
    std::vector<Index> chains;
    std::vector<Vec3> directions;  ///< unit, in which the chains leave
};

/// A plane through two chains of a corner and how good it is.
struct CornerSplit {
    std::size_t first = 0;
    std::size_t second = 0;
    Vec3 normal{0, 0, 0};
    long passes = 0;       ///< hexahedron vertices on it less twice those close to it
    double clearance = 0;  ///< sine of the angle to the nearest of the other chains
    double spread = 0;     ///< mean distance of the hexahedron vertices from it, over the size of the solid

    /// What is equal but for round-off is equal: the choice does not depend on the mesh.
    [[nodiscard]] bool better_than(const CornerSplit& other) const {
        if (passes != other.passes) {
            return passes > other.passes;
        }
        if (std::abs(clearance - other.clearance) > 1e-5) {
            return clearance > other.clearance;
        }
        return spread < other.spread - 1e-5;
    }
};

[[nodiscard]] PAVIOR_INLINE std::optional<CornerSplit> try_split(const CornerRing& ring, std::size_t i, std::size_t j);

/// A corner with one or two chains: a plane across the one, or halfway between the two.
[[nodiscard]] PAVIOR_INLINE std::optional<RepairSheet> cross_sheet(const ReferenceMesh& mesh, const CornerRing& ring);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/repair_corner-inl.hpp>
#endif
