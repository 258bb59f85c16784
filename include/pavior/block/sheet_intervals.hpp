#pragma once
/// \file
/// How often the sheets of blocks are divided.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/core/compiled.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace pavior {

/// What one sheet crosses, and the number of intervals that all these edges get.
struct SheetIntervals {
    std::size_t edges = 0;  ///< block edges that the sheet crosses
    double shortest = 0.0;  ///< their lengths along the geometry
    double longest = 0.0;
    double mean = 0.0;
    double turning = 0.0;  ///< angle on the geometry that nine tenths of them do not exceed, degrees
    std::uint32_t intervals = 1;

    friend bool operator==(const SheetIntervals&, const SheetIntervals&) = default;
};

/// Wished lengths of the edges of hexahedra, in the unit of the coordinates.
struct BlockLengths {
    double size = 0;                   ///< <= 0: no wish
    double max_angle = 30;             ///< with a size: hardly an edge turns by more degrees an interval
    std::map<int, double> curve = {};  ///< on curves of the geometry, by tag
    std::map<int, double> patch = {};  ///< on patches and round them, by tag; the smallest where several meet

    friend bool operator==(const BlockLengths&, const BlockLengths&) = default;
};

/// One entry a sheet: its edges, and as many intervals as bring them to the wished length on the average, 1 at least.
/// In a sheet with edges on curves that have a length of their own only these count, else with edges on or round such
/// patches only those. With a size, sheets that cross chains get as many more as bring every chord as near to its
/// chain as one that turns by max_angle, but none shorter than half the size for that. No wish: two intervals.
/// O(edges).
/// \throws InputError bad_option (a size that is not a number, another length or an angle that is not positive),
/// overflow (10^9 intervals or more)
[[nodiscard]] PAVIOR_INLINE std::vector<SheetIntervals> sheet_intervals(const BlockMesh& blocks,
                                                                        const BlockGeometry& geometry,
                                                                        const BlockPlacement& placement,
                                                                        const BlockLengths& lengths);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/sheet_intervals-inl.hpp>
#endif
