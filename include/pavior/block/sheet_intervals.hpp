#pragma once
/// \file
/// How often the sheets of blocks are divided.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/core/compiled.hpp>

#include <cstddef>
#include <cstdint>
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

/// One entry a sheet: its edges, and as many intervals as bring them to the length \p size on the average, and hardly
/// one to turn by more than \p max_angle degrees an interval, 1 at least. size <= 0: two intervals everywhere. O(edges).
/// \throws InputError bad_option (a size that is not a number, an angle that is not positive), overflow (10^9 intervals or more)
[[nodiscard]] PAVIOR_INLINE std::vector<SheetIntervals> sheet_intervals(const BlockMesh& blocks,
                                                                        const BlockGeometry& geometry,
                                                                        const BlockPlacement& placement, double size,
                                                                        double max_angle = 30.0);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/sheet_intervals-inl.hpp>
#endif
