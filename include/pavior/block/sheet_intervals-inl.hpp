#pragma once

#include <pavior/block/detail/block_curves.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/sheet_intervals.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<SheetIntervals> sheet_intervals(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                          const BlockPlacement& placement, double size,
                                                          double max_angle) {
    if (std::isnan(size) || !(max_angle > 0.0)) {
        throw InputError(ErrorCode::bad_option, "a size that is a number and a positive angle expected");
    }
    const detail::BlockCurves curves(blocks, geometry, placement);
    std::vector<SheetIntervals> sheets(blocks.sheet_count);
    std::vector<std::vector<double>> turnings(blocks.sheet_count);
    for (std::size_t e = 0; e < blocks.edges.size(); ++e) {
        SheetIntervals& sheet = sheets[blocks.sheets[e]];
        const double length = curves.edge_length(static_cast<Index>(e));
        sheet.shortest = sheet.edges == 0 ? length : std::min(sheet.shortest, length);
        sheet.longest = std::max(sheet.longest, length);
        sheet.mean += length;
        turnings[blocks.sheets[e]].push_back(curves.edge_turning(static_cast<Index>(e)));
        ++sheet.edges;
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        sheets[s].mean /= static_cast<double>(std::max<std::size_t>(sheets[s].edges, 1));
        if (std::vector<double>& all = turnings[s]; !all.empty()) {  // a tenth may be crooked ways on rough triangles
            const auto at = all.end() - 1 - static_cast<std::ptrdiff_t>(all.size() / 10);
            std::nth_element(all.begin(), at, all.end());
            sheets[s].turning = *at;
        }
        const double turns = std::ceil(sheets[s].turning / max_angle - 0.1);
        const double wanted = size > 0.0 ? std::max(turns, std::round(sheets[s].mean / size)) : 2.0;
        if (!(wanted < 1e9)) {
            throw InputError(ErrorCode::overflow, "sheet " + std::to_string(s) + " would have 10^9 intervals or more",
                             {static_cast<std::int64_t>(s)});
        }
        sheets[s].intervals = static_cast<std::uint32_t>(std::max(1.0, wanted));
    }
    return sheets;
}

}  // namespace pavior
