#pragma once
/// \file
/// Options of the untangling of quads and hexahedra.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>

#include <cstddef>
#include <cstdint>

namespace pavior {

/// Where a hexahedron must be positive.
enum class HexPositivity : std::uint8_t {
    corners_and_centre,  ///< eight corners and the centre, what quality checkers look at
    sampled,             ///< and the middles of its edges and faces: 27 points of the trilinear map
};

/// Options of untangle_quads(), untangle_surface_quads() and untangle_hexes().
struct UntangleOptions {
    /// Steps of epsilon an attempt may take, >= 1.
    int max_iterations = 150;
    /// Iterations of L-BFGS per step of epsilon, >= 1.
    int inner_iterations = 200;
    /// Weight of the area or volume term against the shape term, finite and > 0.
    double theta = 0.5;
    /// Also optimise what is not inverted: every node that is not fixed may move. The number of inverted cells and the
    /// minimum determinant never get worse.
    bool always = false;
    /// Free the nodes of the inverted cells first (1 ring), then 2, 4, 8 ... rings, until the cells are repaired or
    /// every node is free. False: free every node at once.
    bool local = true;
    /// A patch that is valid but has a smaller determinant than this is tried again with more rings; the better result
    /// counts. In [0, 1); 0 accepts whatever is valid.
    double sufficient_det = 0.05;
    /// A patch that cannot be repaired is kept if fewer of its cells are inverted; true: and if its smallest
    /// determinant does not shrink either.
    bool keep_minimum = false;
    /// Hexahedra only: where they must be positive.
    HexPositivity positivity = HexPositivity::corners_and_centre;
    /// Surface quads only: quads run counter-clockwise about -(d/du x d/dv).
    bool reversed = false;
    /// Length of SmoothReport::inverted_ids at most.
    std::size_t max_ids = 1000;
    /// Threads, and the token that ends the call, which is looked at in every evaluation of the distortion.
    Execution execution = sequential;
    /// Stages "untangle", then "smooth" if `always`: from 0 to 1, never backwards. Silent if nothing is to be done.
    Progress progress = {};
};

namespace detail {

PAVIOR_INLINE void check_options(const UntangleOptions& options);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/options-inl.hpp>
#endif
