#pragma once
/// \file
/// Many-to-many sweep: hexahedra for solids that are extrusions piece by piece, with caps at any number of levels
/// (section 6.8.2 \cite roca2009).

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/extruded_body.hpp>
#include <pavior/many_to_many/layered_hexes.hpp>
#include <pavior/many_to_many/plane_arrangement.hpp>
#include <pavior/many_to_many/plane_region.hpp>
#include <pavior/smooth/report.hpp>

#include <cstddef>

namespace pavior {

struct MultiSweepOptions {
    double size = 0;        ///< wished length of mesh edges, in the plane and along the direction; must be given
    double max_angle = 30;  ///< an edge turns by at most this from one interval to the next, degrees
    /// Curves of different levels that run closer than this times `size` share their nodes: columns lean a little
    /// rather than slivers appear. Halved, curve by curve, as often as needed to keep every face.
    double merge = 0.3;
    double off_face = 0;  ///< boundary nodes may be so far off their faces, beyond 1e-4 times `size`
    double chord = 1e-3;  ///< largest chord error of the polylines of the body, times `size`
    bool smooth = true;   ///< move inner nodes where a hexahedron would be inverted
    Execution execution = sequential;
    Progress progress = {};
};

struct MultiSweepReport {
    double merge = 0;               ///< largest and
    double least_merge = 0;         ///< least tolerance used for a curve, in the unit of the body
    std::size_t refined_cells = 0;  ///< cells whose edges were divided more finely, since no quads fitted in
    std::size_t cells = 0, mapped_cells = 0, levels = 0;
    double worst_plane_ratio = 1, worst_layer_ratio = 1;  ///< deviation of numbers of intervals from the wish
    bool optimal = true;                                  ///< all numbers proven to be the best
    SmoothReport smooth;
};

struct MultiSweepMesh : LayeredHexes {
    MultiSweepReport report;
};

/// Fills \p body with hexahedra. The curves of all its caps are projected into the plane normal to the direction and
/// imprinted into one arrangement, whose cells are divided into quads; over each cell the solid reaches from cap to
/// cap. Every cap is a level of nodes: the levels run through the whole solid, and an integer program spreads the
/// layers between them. Nodes of caps, curves and vertices lie on them, those of sides straight between; inner levels
/// keep the height of their caps where these are flat and follow them smoothly where they are not. A mesh that is given
/// on faces and edges of the body is kept: quad for quad, node for node.
///
/// \p geometry may be any extruded_geometry, \p imprint any plane_imprinter, \p solver any integer_solver and
/// \p mesher any region_mesher. The result is not verified; use verify_hexes(). Deterministic if these
/// are. O(hexahedra) memory and time, but for the solver, and for levels whose caps are not of one height.
/// \throws UnmeshableError not_sweepable naming faces (tags) that are too narrow or have no level, or an edge a vertex
/// of which would share its node with another vertex, or a given mesh without a node where an edge of another level
/// meets it; infeasible_intervals; InputError bad_option, empty_input,
/// size_mismatch; what the callables throw
[[nodiscard]] PAVIOR_INLINE MultiSweepMesh multi_sweep(const ExtrudedBody& body, const AnyExtrudedGeometry& geometry,
                                                       const MultiSweepOptions& options, const PlaneImprinter& imprint,
                                                       const IntegerSolver& solver, const RegionMesher& mesher);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/multi_sweep-inl.hpp>
#endif
