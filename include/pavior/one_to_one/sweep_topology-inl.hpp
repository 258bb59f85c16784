#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<std::pair<OrientedEdge, SideRole>> outline_of(const LinkingSide& side) {
    if (!side.rectangle()) {
        return side.outline;
    }
    std::vector<std::pair<OrientedEdge, SideRole>> result;
    const auto add = [&](const EdgeChain& chain, SideRole role) {
        for (const OrientedEdge& use : chain) {
            result.emplace_back(use, role);
        }
    };
    add(side.bottom, SideRole::bottom);
    add(side.right, SideRole::right);
    add(reversed(side.top), SideRole::top);
    add(reversed(side.left), SideRole::left);
    return result;
}

PAVIOR_INLINE LinkingSide upside_down(const LinkingSide& side) {
    LinkingSide result{side.face,           side.outward,          reversed(side.top),
                       reversed(side.left), reversed(side.bottom), reversed(side.right),
                       side.outline};
    const auto is_bottom = [](const auto& entry) { return entry.second == SideRole::bottom; };
    for (auto& entry : result.outline) {
        entry.second = opposite(entry.second);
    }
    const auto other = std::find_if_not(result.outline.begin(), result.outline.end(), is_bottom);
    std::rotate(result.outline.begin(), other, result.outline.end());
    std::rotate(result.outline.begin(), std::find_if(result.outline.begin(), result.outline.end(), is_bottom),
                result.outline.end());
    return result;
}

PAVIOR_INLINE int chain_intervals(std::span<const OrientedEdge> chain, std::span<const int> intervals) {
    int sum = 0;
    for (const OrientedEdge& use : chain) {
        sum += intervals[use.edge.index()];
    }
    return sum;
}

namespace detail {

/// An edge of a linking side in the sense in which columns or rows grow, and where it starts.
struct PlacedEdge {
    OrientedEdge use;
    int column = 0, row = 0;
};

/// The edges of a side, counter-clockwise, counted from the start of the first bottom edge. Nothing if its intervals do
/// not close.
[[nodiscard]] inline std::optional<std::vector<PlacedEdge>> place_edges(const LinkingSide& side,
                                                                        std::span<const int> intervals) {
    std::vector<PlacedEdge> result;
    int column = 0;
    int row = 0;
    for (const auto& [use, role] : outline_of(side)) {
        const int n = intervals[use.edge.index()];
        const bool back = role == SideRole::top || role == SideRole::left;
        (role == SideRole::top ? column : row) -= back ? n : 0;
        result.push_back({{use.edge, use.forward != back}, column, row});
        (role == SideRole::bottom ? column : row) += back ? 0 : n;
    }
    return column == 0 && row == 0 ? std::optional(std::move(result)) : std::nullopt;
}

/// Grid coordinates of the edges of one loop while its sides are being placed.
class SideGrid {
public:
    explicit SideGrid(int columns) : columns_(columns) {}

    /// Notes where the edges of the source's loop start.
    void note(const EdgeLoop& loop, std::span<const int> intervals) {
        int column = 0;
        for (const OrientedEdge& use : loop) {
            starts_.emplace(use, std::array{wrapped(column), 0});
            column += intervals[use.edge.index()];
        }
    }

    /// False if an edge has been noted elsewhere.
    [[nodiscard]] bool note(const std::vector<PlacedEdge>& edges, const SidePlacement& at) {
        return std::all_of(edges.begin(), edges.end(), [&](const PlacedEdge& e) {
            const std::array place{wrapped(at.column + e.column), at.row + e.row};
            return starts_.emplace(e.use, place).first->second == place;
        });
    }

    /// Finds the place of a side from an edge of it that has been noted.
    [[nodiscard]] bool find(const std::vector<PlacedEdge>& edges, SidePlacement& at) const {
        for (const PlacedEdge& e : edges) {
            if (const auto found = starts_.find(e.use); found != starts_.end()) {
                at.column = wrapped(found->second[0] - e.column);
                at.row = found->second[1] - e.row;
                return true;
            }
        }
        return false;
    }

private:
    [[nodiscard]] int wrapped(int column) const { return ((column % columns_) + columns_) % columns_; }

    int columns_;
    std::map<OrientedEdge, std::array<int, 2>> starts_;
};

}  // namespace detail

PAVIOR_INLINE std::vector<std::vector<SidePlacement>> place_sides(const SweepTopology& sweep,
                                                                  std::span<const int> intervals) {
    std::vector<std::vector<SidePlacement>> result(sweep.loops.size());
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        const std::vector<LinkingSide>& sides = sweep.loops[i];
        const int columns = chain_intervals(sweep.source_loops[i], intervals);
        if (columns <= 0) {
            throw InputError(ErrorCode::bad_index, "a loop of the source has no intervals", {sweep.source.value});
        }
        detail::SideGrid grid(columns);
        grid.note(sweep.source_loops[i], intervals);
        result[i].resize(sides.size());
        std::vector<std::size_t> waiting(sides.size());
        std::iota(waiting.begin(), waiting.end(), std::size_t{0});
        while (!waiting.empty()) {
            const std::size_t before = waiting.size();
            std::erase_if(waiting, [&](std::size_t j) {
                SidePlacement& at = result[i][j];
                const auto edges = detail::place_edges(sides[j], intervals);
                const bool placed = edges && grid.find(*edges, at) && grid.note(*edges, at);
                for (std::size_t e = 0; placed && e < edges->size(); ++e) {
                    at.columns = std::max(at.columns, (*edges)[e].column);
                    at.rows = std::max(at.rows, (*edges)[e].row);
                }
                return placed;
            });
            if (waiting.size() == before) {
                const int face = sides[waiting.front()].face.value;
                throw InputError(ErrorCode::bad_index,
                                 "the intervals given do not fit linking side (face id) " + std::to_string(face),
                                 {face});
            }
        }
    }
    return result;
}

}  // namespace pavior
