#pragma once
/// \file
/// Many-to-many sweep: hexahedra for solids that are extrusions piece by piece, with caps at any number of levels
/// (section 6.8.2 \cite roca2009).

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/caps_over_cells.hpp>
#include <pavior/many_to_many/layered_hexes.hpp>
#include <pavior/many_to_many/level_program.hpp>
#include <pavior/many_to_many/place_layered_nodes.hpp>
#include <pavior/many_to_many/plane_intervals.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>
#include <pavior/smooth/report.hpp>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace pavior {

struct MultiSweepOptions {
    double size = 0;        ///< wished length of mesh edges, in the plane and along the direction; must be given
    double max_angle = 45;  ///< an edge turns by at most this from one interval to the next, degrees
    /// Curves of different levels that run closer than this times `size` share their nodes: columns lean a little
    /// rather than slivers appear. Halved, curve by curve, as often as needed to keep every face.
    double merge = 0.3;
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

namespace detail {

/// The plane of a body, imprinted: cells, and what lies over each.
struct ImprintedBody {
    PlaneArrangement plane;
    std::vector<CapsOverCell> stacks;
    double merge = 0, least_merge = 0;  ///< largest and least tolerance of a curve
};

/// Imprints with the largest tolerances that destroy no face: those of the curves of a face in trouble are halved.
template <extruded_geometry G, plane_imprinter I>
[[nodiscard]] ImprintedBody imprint_body(const ExtrudedBody& body, const G& geometry, const MultiSweepOptions& options,
                                         I&& imprint) {
    constexpr double dent = 1e-4;  // of a side, times the size
    ImprintOptions tolerances;
    tolerances.coincident = 3 * options.chord * options.size;
    tolerances.merge.assign(body.curves.size(), std::max(tolerances.coincident, options.merge * options.size));
    while (true) {
        ImprintedBody result;
        StackResult stacks;
        try {
            result.plane = imprint(body.plane, tolerances);
            stacks = caps_over_cells(body, geometry, result.plane, dent * options.size);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cad_failure) {
                throw;
            }
            stacks.fault = error.what();
            stacks.curves.resize(body.curves.size());
            std::iota(stacks.curves.begin(), stacks.curves.end(), Index{0});
        }
        if (stacks.fault.empty()) {
            result.stacks = std::move(stacks.stacks);
            const auto [least, largest] = std::minmax_element(tolerances.merge.begin(), tolerances.merge.end());
            result.merge = *largest;
            result.least_merge = *least;
            return result;
        }
        bool changed = false;
        std::sort(stacks.curves.begin(), stacks.curves.end());
        stacks.curves.erase(std::unique(stacks.curves.begin(), stacks.curves.end()), stacks.curves.end());
        for (const Index c : stacks.curves) {
            changed = changed || tolerances.merge[c] > tolerances.coincident;
            tolerances.merge[c] = std::max(tolerances.coincident, 0.5 * tolerances.merge[c]);
        }
        if (!changed) {
            throw UnmeshableError(ErrorCode::not_sweepable, stacks.fault,
                                  Error::Ids(stacks.tags.begin(), stacks.tags.end()));
        }
    }
}

/// Wished length of the mesh edges of each edge of the arrangement.
[[nodiscard]] PAVIOR_INLINE std::vector<double> edge_sizes(const ExtrudedBody& body, const PlaneArrangement& plane,
                                                           double size);

[[nodiscard]] PAVIOR_INLINE double height_range(const ExtrudedBody& body);

/// Untangles inverted hexahedra with the nodes of all faces held.
PAVIOR_INLINE SmoothReport smooth_columns(LayeredHexes& mesh, const Execution& execution);

/// Intervals and quads of the plane; where no quads fit into a cell its edges are divided more finely, a few times.
template <extruded_geometry G, integer_solver Solver, class M>
[[nodiscard]] PlaneMesh mesh_imprinted(const ExtrudedBody& body, const G& geometry, const ImprintedBody& imprinted,
                                       const MultiSweepOptions& options, Solver&& solver, M&& mesher,
                                       MultiSweepReport& report) {
    constexpr int tries = 7;
    const PlaneArrangement& plane = imprinted.plane;
    const auto curves = curves_of_edges(plane);
    std::vector<double> sizes = edge_sizes(body, plane, options.size);
    std::vector<double> lengths;
    for (const PlaneEdge& edge : plane.edges) {
        lengths.push_back(polyline_size(edge.points).length);
    }
    std::vector<char> wanted;
    for (const CapsOverCell& stack : imprinted.stacks) {
        wanted.push_back(static_cast<char>(!stack.caps.empty()));
    }
    const auto place = [&](Index edge, const Vec2& x) {
        const Vec3 point = geometry.curve_point(curves[edge].front(), x);
        return Vec2(point.head<2>());
    };
    for (int i = 1;; ++i) {
        const PlaneIntervals intervals =
            plane_intervals(plane, wanted, sizes, options.max_angle * std::numbers::pi / 180, solver);
        report.mapped_cells = intervals.mapped;
        report.worst_plane_ratio = intervals.worst_ratio;
        report.optimal = report.optimal && intervals.optimal;
        std::size_t failures = 0;
        PlaneMesh mesh =
            mesh_plane(plane, intervals.numbers, wanted, place, mesher, [&](Index cell, const Error& error) {
                ++failures;
                if (i == tries) {
                    Error::Ids tags;
                    for (const Index c : imprinted.stacks[cell].caps) {
                        tags.push_back(body.caps[c].tag);
                    }
                    throw UnmeshableError(ErrorCode::cad_failure, error.what(), tags);
                }
                for (const auto& loop : plane.cells[cell].loops) {
                    for (const OrientedPlaneEdge& use : loop) {
                        const double intervals_more = intervals.numbers[use.edge] + 1;
                        sizes[use.edge] = std::min(0.7 * sizes[use.edge], lengths[use.edge] / intervals_more);
                    }
                }
            });
        if (failures == 0) {
            return mesh;
        }
        report.refined_cells += failures;
    }
}

PAVIOR_INLINE void check_multi_sweep(const ExtrudedBody& body, const MultiSweepOptions& options);

}  // namespace detail

/// Fills \p body with hexahedra. The curves of all its caps are projected into the plane normal to the direction and
/// imprinted into one arrangement, whose cells are divided into quads; over each cell the solid reaches from cap to
/// cap. Every cap is a level of nodes: the levels run through the whole solid, and an integer program spreads the
/// layers between them. Nodes of caps, curves and vertices lie on them, those of sides straight between; inner levels
/// keep the height of their caps where these are flat and follow them smoothly where they are not.
///
/// \p imprint makes arrangements (plane_imprinter), \p solver solves integer programs (e.g. `solve`), \p mesher fills
/// plane regions with quads (region_mesher). The result is not verified; use verify_hexes(). Deterministic if these
/// are. O(hexahedra) memory and time, but for the solver, and for levels whose caps are not of one height.
/// \throws UnmeshableError not_sweepable naming faces (tags) that are too narrow or have no level, or an edge a vertex
/// of which would share its node with another vertex; infeasible_intervals; InputError bad_option, empty_input,
/// size_mismatch; what the callables throw
template <extruded_geometry G, plane_imprinter I, integer_solver Solver, region_mesher M>
[[nodiscard]] MultiSweepMesh multi_sweep(const ExtrudedBody& body, const G& geometry, const MultiSweepOptions& options,
                                         I&& imprint, Solver&& solver, M&& mesher) {
    detail::check_multi_sweep(body, options);
    report(options.progress, "imprinting", 0);
    const detail::ImprintedBody imprinted = detail::imprint_body(body, geometry, options, imprint);
    const double tolerance = 1e-6 * (detail::height_range(body) + options.size);
    report(options.progress, "intervals", 0.2);
    MultiSweepReport done;
    const CapLevels levels =
        solve_level_program(body, geometry, imprinted.plane, imprinted.stacks, options.size,
                            LevelTolerance{tolerance, std::max(tolerance, 4 * imprinted.merge)}, solver);
    done.optimal = levels.optimal;
    done.worst_layer_ratio = levels.worst_ratio;
    report(options.progress, "quads", 0.3);
    const PlaneMesh plane = detail::mesh_imprinted(body, geometry, imprinted, options, solver, mesher, done);
    report(options.progress, "layers", 0.6);
    detail::LayeredHexBuilder columns(body, imprinted.plane, plane, imprinted.stacks, levels);
    detail::LayeredNodePlacer<G>(body, geometry, imprinted.plane, imprinted.stacks, plane, levels, columns)
        .place(1e-3 * tolerance);
    done.merge = imprinted.merge;
    done.least_merge = imprinted.least_merge;
    done.cells = imprinted.plane.cells.size();
    done.levels = columns.nodes().levels();
    MultiSweepMesh result{std::move(columns.result()), std::move(done)};
    if (options.smooth) {
        report(options.progress, "smoothing", 0.9);
        result.report.smooth = detail::smooth_columns(result, options.execution);
    }
    report(options.progress, "done", 1);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/multi_sweep-inl.hpp>
#endif
