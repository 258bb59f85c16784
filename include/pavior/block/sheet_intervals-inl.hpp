#pragma once

#include <pavior/block/detail/block_curves.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/sheet_intervals.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

/// Sum of length by wished length over some edges of a sheet.
struct WishedIntervals {
    double sum = 0;
    std::size_t edges = 0;
};

/// What edges with lengths of their own want of each sheet: those on curves before those at patches.
class LocalWishes {
public:
    LocalWishes(const BlockMesh& blocks, const BlockLengths& lengths)
        : blocks_(blocks), lengths_(lengths), patch_length_(lengths.patch.empty() ? 0 : blocks.edges.size(), 0) {
        if (!patch_length_.empty()) {
            find_patch_lengths();
        }
        for (auto& wishes : wishes_) {
            wishes.resize(blocks.sheet_count);
        }
    }

    void add(Index edge, double length) {
        const GeometryEntity& on = blocks_.nodes[blocks_.edge_origin(edge)].geometry;
        const auto curve = on.dimension == 1 ? lengths_.curve.find(on.tag) : lengths_.curve.end();
        if (curve != lengths_.curve.end()) {
            count(wishes_[0][blocks_.sheets[edge]], length / curve->second);
        } else if (!patch_length_.empty() && patch_length_[edge] > 0) {
            count(wishes_[1][blocks_.sheets[edge]], length / patch_length_[edge]);
        }
    }

    /// Intervals that sheet \p s is to have; 0: no local wish.
    [[nodiscard]] double intervals(std::size_t s) const {
        for (const auto& wishes : wishes_) {
            if (wishes[s].edges > 0) {
                return std::max(1.0, std::round(wishes[s].sum / static_cast<double>(wishes[s].edges)));
            }
        }
        return 0;
    }

private:
    static void count(WishedIntervals& wish, double intervals) {
        wish.sum += intervals;
        ++wish.edges;
    }

    /// The smallest length of the patches on which an edge lies, inside or as a side.
    void find_patch_lengths() {
        for (std::size_t h = 0; h < blocks_.hexes.size(); ++h) {
            for (std::size_t f = 0; f < hex_face_edges.size(); ++f) {
                const GeometryEntity& on = blocks_.nodes[blocks_.quad_origin(blocks_.hex_quads[h][f])].geometry;
                const auto wished = on.dimension == 2 ? lengths_.patch.find(on.tag) : lengths_.patch.end();
                for (std::size_t k = 0; wished != lengths_.patch.end() && k < 4; ++k) {
                    double& length =
                        patch_length_[blocks_.hex_edges[h][static_cast<std::size_t>(hex_face_edges[f][k])]];
                    length = length > 0 ? std::min(length, wished->second) : wished->second;
                }
            }
        }
    }

    const BlockMesh& blocks_;
    const BlockLengths& lengths_;
    std::vector<double> patch_length_;  ///< of each edge, 0: none
    std::array<std::vector<WishedIntervals>, 2> wishes_;
};

/// More intervals where chains bend more in one place than in others, but no edges shorter than half the size.
inline void follow_bends(const BlockMesh& blocks, const BlockCurves& curves, const BlockLengths& lengths,
                         std::vector<SheetIntervals>& sheets) {
    for (std::size_t e = 0; e < blocks.edges.size(); ++e) {
        SheetIntervals& sheet = sheets[blocks.sheets[e]];
        const double most = 2.0 * curves.edge_length(static_cast<Index>(e)) / lengths.size;
        sheet.intervals = curves.intervals_round_bends(static_cast<Index>(e), lengths.max_angle, sheet.intervals,
                                                       static_cast<std::uint32_t>(std::min(most, 1e6)));
    }
}

inline void check_lengths(const BlockLengths& lengths) {
    const auto positive = [](const auto& entry) { return entry.second > 0 && std::isfinite(entry.second); };
    if (std::isnan(lengths.size) || !(lengths.max_angle > 0) ||
        !std::all_of(lengths.curve.begin(), lengths.curve.end(), positive) ||
        !std::all_of(lengths.patch.begin(), lengths.patch.end(), positive)) {
        throw InputError(ErrorCode::bad_option, "positive sizes and a positive angle expected");
    }
}

}  // namespace detail

PAVIOR_INLINE std::vector<SheetIntervals> sheet_intervals(const BlockMesh& blocks, const BlockGeometry& geometry,
                                                          const BlockPlacement& placement,
                                                          const BlockLengths& lengths) {
    detail::check_lengths(lengths);
    const detail::BlockCurves curves(blocks, geometry, placement);
    detail::LocalWishes local(blocks, lengths);
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
        local.add(static_cast<Index>(e), length);
    }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        sheets[s].mean /= static_cast<double>(std::max<std::size_t>(sheets[s].edges, 1));
        if (std::vector<double>& all = turnings[s]; !all.empty()) {  // a tenth may be crooked ways on rough triangles
            const auto at = all.end() - 1 - static_cast<std::ptrdiff_t>(all.size() / 10);
            std::nth_element(all.begin(), at, all.end());
            sheets[s].turning = *at;
        }
        const double turns = std::ceil(sheets[s].turning / lengths.max_angle - 0.1);
        const double own = local.intervals(s);
        const double by_size = own > 0 ? own : lengths.size > 0.0 ? std::round(sheets[s].mean / lengths.size) : 0.0;
        const double wanted = by_size > 0 || lengths.size > 0.0 ? std::max(turns, by_size) : 2.0;
        if (!(wanted < 1e9)) {
            throw InputError(ErrorCode::overflow, "sheet " + std::to_string(s) + " would have 10^9 intervals or more",
                             {static_cast<std::int64_t>(s)});
        }
        sheets[s].intervals = static_cast<std::uint32_t>(std::max(1.0, wanted));
    }
    if (lengths.size > 0.0) {
        detail::follow_bends(blocks, curves, lengths, sheets);
    }
    return sheets;
}

}  // namespace pavior
