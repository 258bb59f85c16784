#pragma once
/// \file
/// Solids as unions of logical boxes: what submapping knows about faces and solids.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_corners.hpp>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

/// "face 3" or "faces 3, 5".
[[nodiscard]] PAVIOR_INLINE std::string list(const std::set<int>& tags, const std::string& one,
                                             const std::string& many);

}  // namespace detail

/// One loop of a face in the logical plane of the face: axes s and t, t to the left of s seen from the tip of the
/// face's own normal. Edges without length are left out.
struct LogicalLoop {
    EdgeLoop uses;                    ///< in the sense of the face's own loop
    std::vector<CornerClass> corner;  ///< class of the corner where use i starts
    std::vector<int> heading;         ///< use i runs along 0: +s, 1: +t, 2: -s, 3: -t
};

/// Where a further loop of a face lies: from two vertices of the first loop to the start of the first use of the loop,
/// along s from one, along t from the other. Both ways are positive.
struct LoopLink {
    std::array<std::size_t, 2> anchor{};  ///< uses of the first loop, at whose starts the ways begin
    std::array<double, 2> length{};       ///< of the ways
};

/// A face as a union of logical rectangles. The first use of the first loop runs along +s.
struct LogicalFace {
    std::vector<LogicalLoop> loops;  ///< the outer one first
    std::vector<LoopLink> links;     ///< of loops 1, 2, ...

    [[nodiscard]] bool empty() const { return loops.empty(); }
};

/// How a solid sees one of its faces.
struct LogicalSide {
    OrientedFace face;
    SignedAxis s, t;  ///< the face's axes among those of the solid

    /// Along the outward normal.
    [[nodiscard]] SignedAxis outward() const { return face.outward ? cross(s, t) : -cross(s, t); }
    /// Of a use with the given heading, in the sense of the face's own loop.
    [[nodiscard]] SignedAxis direction(int heading) const {
        const SignedAxis d = heading % 2 == 0 ? s : t;
        return heading < 2 ? d : -d;
    }
};

/// A solid as a union of logical boxes. i, j, k are as near to x, y, z as the 24 turns of a cube allow.
struct SubmapTopology {
    SolidId solid;
    std::vector<LogicalSide> sides;  ///< in the order of the model's solid_faces
    double deviation = 0.0;          ///< largest difference of an angle (corner or dihedral) from its class, degrees
};

/// The submappable solids of a model. Solids that share a face agree on its logical shape.
struct SubmapModel {
    std::vector<LogicalFace> faces;  ///< by face id; empty for faces of no solid asked for
    std::vector<SubmapTopology> solids;
    /// Vertices lie along the axes of straight solids as they do in space, whatever the lengths of their edges: for
    /// solids with SubmapOptions::turns, whose edges are bent.
    bool as_in_space = false;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/submap_topology-inl.hpp>
#endif
