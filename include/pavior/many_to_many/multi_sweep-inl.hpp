#pragma once

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/caps_over_cells.hpp>
#include <pavior/many_to_many/detail/layered_hex_builder.hpp>
#include <pavior/many_to_many/level_program.hpp>
#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/many_to_many/place_layered_nodes.hpp>
#include <pavior/many_to_many/plane_intervals.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>
#include <pavior/smooth/hexes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Wished length of the mesh edges of each edge of the arrangement.
[[nodiscard]] inline std::vector<double> edge_sizes(const ExtrudedBody& body, const PlaneArrangement& plane,
                                                    double size) {
    std::vector<double> result(plane.edges.size(), 0);
    for (Index c = 0; c < plane.routes.size(); ++c) {
        for (const OrientedPlaneEdge& use : plane.routes[c]) {
            const double own = body.curves[c].size > 0 ? body.curves[c].size : size;
            result[use.edge] = result[use.edge] > 0 ? std::min(result[use.edge], own) : own;
        }
    }
    return result;
}

/// Whether each edge of the arrangement joins two nodes of a mesh that is given; empty if nothing is given.
[[nodiscard]] inline std::vector<char> given_edges(const ExtrudedBody& body, const PlaneArrangement& plane) {
    std::vector<char> result;
    for (Index c = 0; c < body.curves.size(); ++c) {
        if (body.curves[c].given) {
            result.resize(plane.edges.size(), 0);
            for (const OrientedPlaneEdge& use : plane.routes[c]) {
                result[use.edge] = 1;
            }
        }
    }
    return result;
}

/// Curve \p c runs through \p vertex of the arrangement, or ends there.
[[nodiscard]] inline bool passes(const PlaneArrangement& plane, Index c, Index vertex) {
    return std::any_of(plane.routes[c].begin(), plane.routes[c].end(), [&](const OrientedPlaneEdge& use) {
        return plane.edges[use.edge].vertices[0] == vertex || plane.edges[use.edge].vertices[1] == vertex;
    });
}

/// What is wrong with the given curve \p c, which is not one edge of the arrangement.
[[nodiscard]] inline std::string given_fault(const ExtrudedBody& body, const PlaneArrangement& plane, Index c) {
    if (plane.routes[c].empty()) {
        return "has nodes within the tolerance of each other";
    }
    const OrientedPlaneEdge& first = plane.routes[c][0];
    const Index cut = plane.edges[first.edge].vertices[first.forward ? 1 : 0];
    for (Index k = 0; k < body.curves.size(); ++k) {
        if (!body.curves[k].given && passes(plane, k, cut)) {
            return "has no node where it meets, seen along the direction, edge " + std::to_string(body.curves[k].tag);
        }
    }
    return "and that of another, seen along the direction, have different nodes";
}

/// Curves between neighbouring given nodes that shrank to a point, or that another curve cuts.
[[nodiscard]] inline StackResult check_given(const ExtrudedBody& body, const PlaneArrangement& plane) {
    for (Index c = 0; c < body.curves.size(); ++c) {
        const ExtrudedCurve& curve = body.curves[c];
        if (!curve.given || plane.routes[c].size() == 1) {
            continue;
        }
        const std::string at =
            curve.face != 0 ? "face " + std::to_string(curve.face) : "edge " + std::to_string(curve.tag);
        StackResult result;
        result.fault = at + ": the mesh that a neighbour gives there " + given_fault(body, plane, c);
        result.curves = {c};
        const auto add = [&](const std::vector<Index>& curves, int tag) {
            if (std::find(curves.begin(), curves.end(), c) != curves.end()) {
                result.tags.push_back(tag);
            }
        };
        for (const ExtrudedCap& cap : body.caps) {
            add(cap.curves, cap.tag);
        }
        for (const ExtrudedSide& side : body.sides) {
            add(side.curves, side.tag);
        }
        if (result.tags.empty()) {
            result.tags.push_back(curve.face);
        }
        return result;
    }
    return {};
}

[[nodiscard]] inline double height_range(const ExtrudedBody& body) {
    double low = body.vertices.empty() ? 0 : body.vertices[0][2];
    double high = low;
    for (const Vec3& v : body.vertices) {
        low = std::min(low, v[2]);
        high = std::max(high, v[2]);
    }
    return high - low;
}

/// Untangles inverted hexahedra with the nodes of all faces held.
inline SmoothReport smooth_columns(LayeredHexes& mesh, const Execution& execution) {
    std::vector<std::uint8_t> fixed(mesh.mesh.nodes.size(), 0);
    for (const QuadCorners& quad : mesh.quads) {
        for (const Index i : quad) {
            fixed[i] = 1;
        }
    }
    UntangleOptions options;
    options.execution = execution;
    options.max_iterations = 40;
    options.inner_iterations = 50;
    return untangle_hexes(mesh.mesh.nodes, mesh.mesh.hexes, fixed, options);
}

inline void check_multi_sweep(const ExtrudedBody& body, const MultiSweepOptions& options) {
    const auto require = [](bool condition, const char* text) {
        if (!condition) {
            throw InputError(ErrorCode::bad_option, text);
        }
    };
    require(options.size > 0 && std::isfinite(options.size), "MultiSweepOptions::size must be positive");
    require(options.max_angle > 0, "MultiSweepOptions::max_angle must be positive");
    require(options.chord > 0 && options.chord <= 0.1, "MultiSweepOptions::chord must lie in (0, 0.1]");
    require(options.merge >= 0 && options.merge <= 0.5, "MultiSweepOptions::merge must lie in [0, 0.5]");
    if (body.caps.empty()) {
        throw InputError(ErrorCode::empty_input, "the body has no caps");
    }
    if (body.plane.size() != body.curves.size()) {
        throw InputError(ErrorCode::size_mismatch, "one polyline a curve expected");
    }
}

/// The plane of a body, imprinted: cells, and what lies over each.
struct ImprintedBody {
    PlaneArrangement plane;
    std::vector<CapsOverCell> stacks;
    double merge = 0, least_merge = 0;  ///< largest and least tolerance of a curve
};

/// Imprints with the largest tolerances that destroy no face: those of the curves of a face in trouble are halved.
[[nodiscard]] inline ImprintedBody imprint_body(const ExtrudedBody& body, const AnyExtrudedGeometry& geometry,
                                                const MultiSweepOptions& options, const PlaneImprinter& imprint) {
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
            if (StackResult given = check_given(body, result.plane); stacks.fault.empty() && !given.fault.empty()) {
                stacks = std::move(given);
            }
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

/// Intervals and quads of the plane; where no quads fit into a cell its edges are divided more finely, a few times.
[[nodiscard]] inline PlaneMesh mesh_imprinted(const ExtrudedBody& body, const AnyExtrudedGeometry& geometry,
                                              const ImprintedBody& imprinted, const MultiSweepOptions& options,
                                              const IntegerSolver& solver, const RegionMesher& mesher,
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
    const std::vector<char> given = given_edges(body, plane);
    const auto fill = [&](const PlaneRegion& region) {
        if (!given.empty() && region.size() == 1 && region.points.size() == 4) {
            return PlaneQuadMesh{region.points, {{0, 1, 2, 3}}};
        }
        return mesher(region);
    };
    for (int i = 1;; ++i) {
        const PlaneIntervals intervals =
            plane_intervals(plane, wanted, sizes, options.max_angle * std::numbers::pi / 180, solver, given);
        report.mapped_cells = intervals.mapped;
        report.worst_plane_ratio = intervals.worst_ratio;
        report.optimal = report.optimal && intervals.optimal;
        std::size_t failures = 0;
        PlaneMesh mesh = mesh_plane(plane, intervals.numbers, wanted, place, fill, [&](Index cell, const Error& error) {
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

}  // namespace detail

PAVIOR_INLINE MultiSweepMesh multi_sweep(const ExtrudedBody& body, const AnyExtrudedGeometry& geometry,
                                         const MultiSweepOptions& options, const PlaneImprinter& imprint,
                                         const IntegerSolver& solver, const RegionMesher& mesher) {
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
    detail::LayeredNodePlacer(body, geometry, imprinted.plane, imprinted.stacks, plane, levels, columns)
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
