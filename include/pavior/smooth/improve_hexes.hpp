#pragma once
/// \file
/// Untangles and optimises hexahedra, the worst first; boundary nodes may slide on their curves and surfaces.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/smooth/detail/guide_view.hpp>
#include <pavior/smooth/node_guide.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Options of improve_hexes().
struct ImproveOptions {
    /// Cells that reach this scaled Jacobian are left alone. In (0, 1]; 1: as good as it gets. What a mesh needs, say
    /// 0.5, is much faster.
    double target = 1.0;
    /// When the worst cell is stuck, work goes on for the cells below this, and ends for the others. In [0, 1].
    double sufficient = 0.3;
    /// Raising a cell by less counts as nothing. In (0, 0.5].
    double gain = 0.01;
    /// Rings of cells whose nodes are freed round a cell at most, 1 to 1000. A cell is stuck after one attempt without
    /// gain with each.
    int rings = 2;
    /// Attempts on one cell at most, >= 1; at most 2 * rings while it is inverted.
    int attempts = 30;
    /// Work on the worst at most: evaluations times cells of their patch, divided by the cells of the mesh (1000 at
    /// least). Above 0. 1000 take about a minute for 10^5 hexahedra with one thread; 10 to 100 are usual.
    double effort = 1000.0;
    /// Where a hexahedron must be positive, and its quality is taken.
    HexPositivity positivity = HexPositivity::corners_and_centre;
    /// Length of SmoothReport::inverted_ids at most.
    std::size_t max_ids = 1000;
    /// Threads, and the token that ends the call, which is looked at in every evaluation of a patch.
    Execution execution = sequential;
    /// Stages "untangle" if something is inverted, then "improve": from 0 to 1, never backwards. Silent if the mesh is
    /// as good as wanted.
    Progress progress = {};
};

/// A mesh with other nodes.
struct ImprovedHexes {
    std::vector<Vec3> nodes;  ///< as many, in the same order
    SmoothReport report;
};

namespace detail {

/// \throws InputError size_mismatch if a guide that knows \p known nodes is to guide \p nodes
PAVIOR_INLINE void check_guide(std::size_t known, std::size_t nodes);

/// improve_hexes() with the \p freedoms of a guide. \pre check_improve() has passed
PAVIOR_INLINE SmoothReport improve(std::span<Vec3> nodes, std::span<const HexCorners> hexes, const GuideView& guide,
                                   std::span<const Freedom> freedoms, const ImproveOptions& options,
                                   std::span<const Vec3> reference);

/// \throws InputError bad_option, size_mismatch, bad_index, not_finite
PAVIOR_INLINE void check_improve(std::span<Vec3> nodes, std::span<const HexCorners> hexes,
                                 const ImproveOptions& options, std::span<const Vec3> reference);

}  // namespace detail

/// Untangles hexahedra, then raises their smallest scaled Jacobian, the worst first. Never worse than the input: the
/// number of inverted hexahedra does not grow, the minimum does not shrink, and of a mesh without inverted hexahedra
/// the sorted scaled Jacobians grow in lexicographic order. Nodes are fixed, free, or slide on a curve or surface.
///
/// 1. Inverted hexahedra are repaired as in untangle_hexes(): foldover-free maps \cite garanzha2021 on patches that
///    grow ring by ring. That energy finds a valid mesh from far away, but it sums the distortion against cubes (or the
///    reference) over a patch: its minimum is the best mesh neither in the worst cell nor for thin layers. The authors
///    bound the largest distortion, over the whole mesh; here it is angles, and only near the worst.
/// 2. The worst hexahedra, those within 0.1 of the minimum, are seeds, and their nodes are freed (with one ring more
///    round those that gained nothing so far). Each connected patch minimises the sum of (m / (q - t))^2 over its
///    scaled Jacobians q, t below the smallest by m, again and again while that rises: a barrier that tends to max-min.
///    A little weight on the lengths of edges keeps sizes: layers stay thin. Nodes that slide move in the tangent space
///    and are projected after each minimisation. What would break the promise above goes back, node by node.
/// 3. It ends when every hexahedron is within options.gain of options.target (or of what corners between its fixed
///    nodes allow), when the worst that could be better is stuck (one attempt with each number of rings gained less
///    than options.gain, or options.attempts are used up) and those below options.sufficient are too, or when
///    options.effort is spent.
///
/// \param nodes      coordinates, in and out. Any unit: the result scales and moves with the input (up to rounding).
/// \param hexes      corners, numbered as HexCorners.
/// \param guide      what holds each node, see node_guide; FixedNodes and GuidedNodes are ready-made. Fixed nodes do
///                   not change by a bit. Nodes that slide lie on their curve or surface when moved, as exactly as it
///                   projects; those not moved stay as given.
/// \param reference  only for step 1, as in untangle_hexes().
/// \return the report. A hexahedron with an inverted corner between fixed nodes, or with one that contradicts others
/// at a fixed node, is not worked on: it is reported.
/// \throws InputError size_mismatch (of the guide, too), bad_index, not_finite, bad_option; Stopped; and what the guide
/// throws. The nodes are as they were then.
/// O(hexahedra) if the minimum is at options.target already, otherwise O(hexahedra) a round and O(patch) an iteration.
/// The same bytes for any number of threads; patches run in parallel, those with sliding nodes only if the guide is
/// concurrent. Not to be called on one mesh from two threads.
template <node_guide G>
SmoothReport improve_hexes(std::span<Vec3> nodes, std::span<const HexCorners> hexes, const G& guide,
                           const ImproveOptions& options = {}, std::span<const Vec3> reference = {}) {
    detail::check_improve(nodes, hexes, options, reference);
    if constexpr (requires { guide.size(); }) {
        detail::check_guide(static_cast<std::size_t>(guide.size()), nodes.size());
    }
    std::vector<Freedom> freedoms(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        freedoms[i] = guide.freedom(static_cast<Index>(i));
    }
    return detail::improve(nodes, hexes, detail::GuideView(guide), freedoms, options, reference);
}

/// The same for any hex_mesh, which is not changed.
template <hex_mesh M, node_guide G>
[[nodiscard]] ImprovedHexes improve_hexes(const M& mesh, const G& guide, const ImproveOptions& options = {},
                                          std::span<const Vec3> reference = {}) {
    HexMesh copy = to_hex_mesh(mesh);
    SmoothReport report =
        improve_hexes(std::span(copy.nodes), std::span<const HexCorners>(copy.hexes), guide, options, reference);
    return {std::move(copy.nodes), std::move(report)};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/improve_hexes-inl.hpp>
#endif
