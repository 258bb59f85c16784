#pragma once
/// \file
/// What a one-to-one sweep is made of: caps, linking sides with four logical sides, and where each side lies in the
/// structured grid round its loop.

#include <pavior/brep/edge_chain.hpp>
#include <pavior/core/compiled.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
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
[[nodiscard]] PAVIOR_INLINE std::vector<std::pair<OrientedEdge, SideRole>> outline_of(const LinkingSide& side);

/// The side as the sweep from target to source sees it.
[[nodiscard]] PAVIOR_INLINE LinkingSide upside_down(const LinkingSide& side);

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
[[nodiscard]] PAVIOR_INLINE int chain_intervals(std::span<const OrientedEdge> chain, std::span<const int> intervals);

/// Where the linking sides lie in the grids of their loops: element [i][j] belongs to `sweep.loops[i][j]`.
/// \p intervals holds the number of intervals per edge id and satisfies the sweep (intervals.hpp).
/// O(e log e) for e edges if the sides are in the order of SweepTopology. \throws InputError bad_index, naming the face
/// ids, if opposite logical sides of a side differ, a side cannot be reached from the source, or two sides do not agree
/// where an edge is.
[[nodiscard]] PAVIOR_INLINE std::vector<std::vector<SidePlacement>> place_sides(const SweepTopology& sweep,
                                                                                std::span<const int> intervals);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/sweep_topology-inl.hpp>
#endif
