#pragma once
/// \file
/// What a one-to-one sweep is made of: caps, linking sides with four logical sides, and where each side lies in the
/// structured grid round its loop.

#include <pavior/brep/edge_chain.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Which logical side of its linking side a half-edge belongs to. Half-edges of the caps have none.
enum class SideRole : std::uint8_t { bottom, right, top, left, none };

/// The role that the other half-edge of an edge inside the linking surface must have.
[[nodiscard]] constexpr SideRole opposite(SideRole role) {
    return role == SideRole::none ? role : static_cast<SideRole>((static_cast<int>(role) + 2) % 4);
}

/// A linking side: a face with four logical sides, each a chain of one or more edges. Seen from outside the solid with
/// the source below,
/// \verbatim
///        top ->
///      +--------+      bottom and top run along the loop of the source,
/// left |        | right    left and right from the source to the target;
///   ^  |        |  ^   left.start = bottom.start, bottom.end = right.start,
///      +--------+      left.end = top.start, top.end = right.end.
///       bottom ->
/// \endverbatim
/// On a closed side (the wall of a round hole) right and left are the same chain: the seam of the face.
///
/// A side may also be a union of such rectangles, with corners of 270 degrees: then `outline` is the loop of the face
/// seen from outside, counter-clockwise, with the logical side that each edge belongs to, and bottom, right, top and
/// left hold all edges of theirs, in the senses above, which need not follow each other.
struct LinkingSide {
    FaceId face;
    bool outward = true;  ///< the face's own normal leaves the solid
    EdgeChain bottom, right, top, left;
    std::vector<std::pair<OrientedEdge, SideRole>> outline = {};  ///< empty for a rectangle; begins with a bottom edge

    [[nodiscard]] bool rectangle() const { return outline.empty(); }
    [[nodiscard]] bool closed() const { return right == left; }
    friend bool operator==(const LinkingSide&, const LinkingSide&) = default;
};

/// The loop of a linking side seen from outside, counter-clockwise from the first bottom edge, each edge with the
/// logical side that it belongs to.
[[nodiscard]] inline std::vector<std::pair<OrientedEdge, SideRole>> outline_of(const LinkingSide& side) {
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

/// The side as the sweep from target to source sees it.
[[nodiscard]] inline LinkingSide upside_down(const LinkingSide& side) {
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

/// How well shaped a sweep promises to be; the terms by which candidates are ranked (see `better_sweep`).
struct SweepShape {
    double corner_deviation = 0.0;  ///< of an interior angle of a linking side from 90 (270), degrees
    double cap_deviation = 0.0;     ///< largest |angle inside the solid between cap and linking side - 90|, degrees
    double rib_ratio = 1.0;         ///< longest over shortest way from source to target along the ribs
    double rib_turn = 0.0;          ///< largest turning of one rib, degrees
    double cap_warp = 0.0;          ///< largest angle between normals along the boundary of one cap, degrees
    std::size_t cap_loops = 0;      ///< loops of one cap
    std::size_t cap_edges = 0;      ///< edges of both caps
};

/// The solid as a sweep from a source face to a target face.
///
/// The sweep direction enters the solid through the source. Loops are counter-clockwise seen from the tip of the sweep
/// direction (holes clockwise): the material of the cap lies on the left when seen from inside the solid at the source
/// and from outside at the target.
///
/// Loop i of the source corresponds to loop i of the target. `loops[i]` holds its linking sides. If `stacked` is false
/// each of them reaches from source to target, they are in cyclic order along the loop (`sides[j].right` is
/// `sides[j + 1].left`) and both cap loops start at `sides[0]`. If it is true, sides may also lie above each other:
/// the order is from the source to the target, and `place_sides` tells where each one belongs.
struct SweepTopology {
    SolidId solid;
    FaceId source, target;
    bool source_outward = true;  ///< the source's own normal leaves the solid
    bool target_outward = true;  ///< the target's own normal leaves the solid
    bool stacked = false;
    std::vector<EdgeLoop> source_loops, target_loops;
    std::vector<std::vector<LinkingSide>> loops;
    SweepShape shape;
};

/// Place of a linking side in the grid of its loop: columns are intervals of the source loop counted from the start of
/// `source_loops[i]`, rows are layers counted from the source.
struct SidePlacement {
    int column = 0, row = 0;    ///< of the start of the first bottom edge; 0 <= column < columns of the loop
    int columns = 0, rows = 0;  ///< from there to the rightmost column and the highest row of the side

    friend bool operator==(const SidePlacement&, const SidePlacement&) = default;
};

/// Intervals of a chain: the sum over its edges of \p intervals (per edge id).
[[nodiscard]] inline int chain_intervals(std::span<const OrientedEdge> chain, std::span<const int> intervals) {
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

/// Where the linking sides lie in the grids of their loops: element [i][j] belongs to `sweep.loops[i][j]`.
/// \p intervals holds the number of intervals per edge id and satisfies the sweep (intervals.hpp).
/// O(e log e) for e edges if the sides are in the order of SweepTopology. \throws InputError bad_index, naming the face
/// ids, if opposite logical sides of a side differ, a side cannot be reached from the source, or two sides do not agree
/// where an edge is.
[[nodiscard]] inline std::vector<std::vector<SidePlacement>> place_sides(const SweepTopology& sweep,
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
