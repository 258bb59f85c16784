#pragma once
/// \file
/// What a one-to-one sweep is made of: caps, linking sides with four logical sides, and where each side lies in the
/// structured grid round its loop.

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/model/brep.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// Edges head to tail.
using EdgeChain = std::vector<OrientedEdge>;

/// The chain run the other way round.
[[nodiscard]] inline EdgeChain reversed(std::span<const OrientedEdge> chain) {
    EdgeChain result;
    result.reserve(chain.size());
    for (std::size_t i = chain.size(); i-- > 0;) {
        result.push_back({chain[i].edge, !chain[i].forward});
    }
    return result;
}

/// The vertex where \p use begins.
template <brep B>
[[nodiscard]] VertexId first_vertex(const B& b, OrientedEdge use) {
    return b.edge_vertices(use.edge)[use.forward ? 0 : 1];
}

/// The vertex where \p use ends.
template <brep B>
[[nodiscard]] VertexId last_vertex(const B& b, OrientedEdge use) {
    return b.edge_vertices(use.edge)[use.forward ? 1 : 0];
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
struct LinkingSide {
    FaceId face;
    bool outward = true;  ///< the face's own normal leaves the solid
    EdgeChain bottom, right, top, left;

    [[nodiscard]] bool closed() const { return right == left; }
    friend bool operator==(const LinkingSide&, const LinkingSide&) = default;
};

/// How well shaped a sweep promises to be; the terms by which candidates are ranked (see `better_sweep`).
struct SweepShape {
    double corner_deviation = 0.0;  ///< largest |interior angle - 90| of a corner of a linking side, degrees
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
    int column = 0, row = 0;    ///< of bottom.start; 0 <= column < columns of the loop
    int columns = 0, rows = 0;  ///< intervals along bottom (= top) and along left (= right)

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

/// Grid coordinates of the edges of one loop while its sides are being placed.
class SideGrid {
public:
    SideGrid(std::span<const int> intervals, int columns) : intervals_(intervals), columns_(columns) {}

    /// Notes the two ends of each edge of a chain that starts at (column, row) and runs by (1, 0) or (0, 1) a step.
    void note(std::span<const OrientedEdge> chain, int column, int row, bool horizontal) {
        for (const OrientedEdge& use : chain) {
            const int n = intervals_[use.edge.index()];
            starts_.emplace(use, std::array{wrapped(column), row});
            (horizontal ? column : row) += n;
        }
    }

    void note(const LinkingSide& side, const SidePlacement& at) {
        note(side.bottom, at.column, at.row, true);
        note(side.top, at.column, at.row + at.rows, true);
        note(side.left, at.column, at.row, false);
        note(side.right, at.column + at.columns, at.row, false);
    }

    /// Finds the place of \p side from an edge of it that has been noted.
    [[nodiscard]] bool find(const LinkingSide& side, SidePlacement& at) const {
        return find(side.bottom, 0, 0, true, at) || find(side.left, 0, 0, false, at) ||
               find(side.right, at.columns, 0, false, at) || find(side.top, 0, at.rows, true, at);
    }

private:
    [[nodiscard]] int wrapped(int column) const { return ((column % columns_) + columns_) % columns_; }

    [[nodiscard]] bool find(std::span<const OrientedEdge> chain, int column, int row, bool horizontal,
                            SidePlacement& at) const {
        for (const OrientedEdge& use : chain) {
            if (const auto found = starts_.find(use); found != starts_.end()) {
                at.column = wrapped(found->second[0] - column);
                at.row = found->second[1] - row;
                return true;
            }
            (horizontal ? column : row) += intervals_[use.edge.index()];
        }
        return false;
    }

    std::span<const int> intervals_;
    int columns_;
    std::map<OrientedEdge, std::array<int, 2>> starts_;
};

}  // namespace detail

/// Where the linking sides lie in the grids of their loops: element [i][j] belongs to `sweep.loops[i][j]`.
/// \p intervals holds the number of intervals per edge id and satisfies the sweep (intervals.hpp).
/// O(e log e) for e edges. \throws InputError bad_index, naming the face ids, if opposite logical sides of a side
/// differ or a side cannot be reached from the source.
[[nodiscard]] inline std::vector<std::vector<SidePlacement>> place_sides(const SweepTopology& sweep,
                                                                         std::span<const int> intervals) {
    std::vector<std::vector<SidePlacement>> result(sweep.loops.size());
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        const std::vector<LinkingSide>& sides = sweep.loops[i];
        const int columns = chain_intervals(sweep.source_loops[i], intervals);
        if (columns <= 0) {
            throw InputError(ErrorCode::bad_index, "a loop of the source has no intervals", {sweep.source.value});
        }
        detail::SideGrid grid(intervals, columns);
        grid.note(sweep.source_loops[i], 0, 0, true);
        for (const LinkingSide& side : sides) {
            SidePlacement at{0, 0, chain_intervals(side.bottom, intervals), chain_intervals(side.left, intervals)};
            if (at.columns != chain_intervals(side.top, intervals) ||
                at.rows != chain_intervals(side.right, intervals) || !grid.find(side, at)) {
                throw InputError(
                    ErrorCode::bad_index,
                    "the intervals given do not fit linking side (face id) " + std::to_string(side.face.value),
                    {side.face.value});
            }
            grid.note(side, at);
            result[i].push_back(at);
        }
    }
    return result;
}

}  // namespace pavior
