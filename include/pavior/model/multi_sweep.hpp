#pragma once
/// \file
/// Many-to-many sweep: hexahedra for solids that are extrusions piece by piece, with caps at any number of levels
/// (section 6.8.2 \cite roca2009).

#include <pavior/core/error.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/model/cell_stacks.hpp>
#include <pavior/model/column_levels.hpp>
#include <pavior/model/column_mesh.hpp>
#include <pavior/model/plane_intervals.hpp>
#include <pavior/model/plane_mesh.hpp>
#include <pavior/smooth/hexes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
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

struct MultiSweepMesh : ColumnMesh {
    MultiSweepReport report;
};

namespace detail {

/// The plane of a body, imprinted: cells, and what lies over each.
struct ImprintedBody {
    PlaneArrangement plane;
    std::vector<CellStack> stacks;
    double merge = 0, least_merge = 0;  ///< largest and least tolerance of a curve
};

/// Imprints with the largest tolerances that destroy no face: those of the curves of a face in trouble are halved.
template <extruded_geometry G, plane_imprinter I>
[[nodiscard]] ImprintedBody imprint_body(const ExtrudedBody& body, const G& geometry, const MultiSweepOptions& options,
                                         I&& imprint) {
    ImprintOptions tolerances;
    tolerances.coincident = 3 * options.chord * options.size;
    tolerances.merge.assign(body.curves.size(), std::max(tolerances.coincident, options.merge * options.size));
    while (true) {
        ImprintedBody result;
        StackResult stacks;
        try {
            result.plane = imprint(body.plane, tolerances);
            stacks = cell_stacks(body, geometry, result.plane);
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

/// Puts nodes on the caps, curves and vertices of a body, and all others between them.
template <extruded_geometry G>
class ColumnPlacer {
public:
    ColumnPlacer(const ExtrudedBody& body, const G& geometry, const ImprintedBody& imprinted, const PlaneMesh& plane,
                 const ColumnLevels& levels, ColumnBuilder& columns)
        : body_(body),
          geometry_(geometry),
          imprinted_(imprinted),
          plane_(plane),
          levels_(levels),
          columns_(columns),
          places_(columns.result().mesh.nodes),
          how_(places_.size(), NodePlace::none) {}

    /// \p tolerance: heights closer than this are equal.
    void place(double tolerance) {
        place_curves();
        place_in_plane(1e3 * tolerance);
        place_caps();
        extend(tolerance);
        fill();
        for (Vec3& node : places_) {
            node = body_.frame.to_space(node);
        }
    }

private:
    [[nodiscard]] Index id(Index p, int level) const { return columns_.nodes()(p, static_cast<std::size_t>(level)); }

    void put(Index id, const Vec3& at, NodePlace how) {
        if (id != no_index && how >= how_[id]) {
            places_[id] = at;
            how_[id] = how;
        }
    }

    void place_caps() {
        for (std::size_t cell = 0; cell < plane_.cell_count(); ++cell) {
            for (const Index c : imprinted_.stacks[cell].caps) {
                for (std::size_t q = plane_.cell_quads[cell]; q < plane_.cell_quads[cell + 1]; ++q) {
                    for (const Index p : plane_.quads[q]) {
                        const Index node = id(p, levels_.caps[c]);
                        if (how_[node] == NodePlace::none) {
                            const Vec2 at = places_[node].template head<2>();
                            put(node, {at[0], at[1], geometry_.cap_height(c, at)}, NodePlace::cap);
                        }
                    }
                }
            }
        }
    }

    void place_curves() {
        for (Index c = 0; c < body_.curves.size(); ++c) {
            for (const OrientedPlaneEdge& use : imprinted_.plane.routes[c]) {
                for (const Index p : plane_.edges[use.edge]) {
                    put(id(p, levels_.curves[c]), geometry_.curve_point(c, plane_.nodes[p]), NodePlace::exact);
                }
            }
        }
        for (Index c = 0; c < body_.curves.size(); ++c) {
            for (std::size_t k = 0; k < 2; ++k) {
                const Index v = body_.curves[c].vertices[k];
                put(id(imprinted_.plane.ends[c][k], levels_.vertices[v]), body_.vertices[v], NodePlace::exact);
            }
        }
    }

    /// Calls visit(first, last) for each run of levels at which a column has nodes.
    template <class Visit>
    void for_runs(Index p, Visit&& visit) const {
        const ColumnNodes& nodes = columns_.nodes();
        for (std::size_t first = 0; first < nodes.levels(); ++first) {
            std::size_t last = first;
            while (last < nodes.levels() && nodes(p, last) != no_index) {
                ++last;
            }
            if (last > first) {
                visit(first, last - 1);
                first = last;
            }
        }
    }

    /// The plane coordinates of all nodes: columns on edges lean from one curve to the next, inner ones follow.
    void place_in_plane(double tolerance) {
        double farthest = 0;
        for (Index p = 0; p < plane_.nodes.size(); ++p) {
            for_runs(p, [&](std::size_t first, std::size_t last) {
                farthest = std::max(farthest, lean_column(p, first, last));
            });
        }
        if (farthest <= tolerance) {
            return;
        }
        const InnerLaplace laplace(plane_.nodes, plane_.quads, plane_.edge_nodes);
        Eigen::MatrixX2d shift(static_cast<Eigen::Index>(plane_.edge_nodes), 2);
        for (std::size_t level = 0; level < columns_.nodes().levels(); ++level) {
            shift.setZero();
            for (Index p = 0; p < plane_.edge_nodes; ++p) {
                if (const Index node = columns_.nodes()(p, level); node != no_index) {
                    shift.row(p) = (places_[node].template head<2>() - plane_.nodes[p]).transpose();
                }
            }
            if (shift.cwiseAbs().maxCoeff() <= tolerance) {
                continue;
            }
            const Eigen::MatrixX2d inner = laplace.solve(shift);
            for (auto p = static_cast<Index>(plane_.edge_nodes); p < plane_.nodes.size(); ++p) {
                if (const Index node = columns_.nodes()(p, level); node != no_index) {
                    const auto row = static_cast<Eigen::Index>(p - plane_.edge_nodes);
                    places_[node].template head<2>() += inner.row(row).transpose();
                }
            }
        }
    }

    /// Plane coordinates of one run of a column, linear between the exact ones. Returns the farthest shift.
    double lean_column(Index p, std::size_t first, std::size_t last) {
        const auto node = [&](std::size_t level) { return columns_.nodes()(p, level); };
        double farthest = 0;
        std::optional<std::size_t> below;
        for (std::size_t level = first; level <= last; ++level) {
            if (how_[node(level)] != NodePlace::exact) {
                const Vec2 at = below ? Vec2(places_[node(*below)].template head<2>()) : plane_.nodes[p];
                places_[node(level)].template head<2>() = at;
                continue;
            }
            const Vec2 to = places_[node(level)].template head<2>();
            farthest = std::max(farthest, (to - plane_.nodes[p]).norm());
            const std::size_t start = below.value_or(first);
            const Vec2 from = below ? Vec2(places_[node(*below)].template head<2>()) : to;
            for (std::size_t k = below ? start + 1 : start; k < level; ++k) {
                const double t = static_cast<double>(k - start) / static_cast<double>(level - start);
                places_[node(k)].template head<2>() = (1 - t) * from + t * to;
            }
            below = level;
        }
        return farthest;
    }

    /// Quads of the cells in which a level touches the solid.
    [[nodiscard]] std::vector<QuadCorners> sheet(std::size_t level) const {
        std::vector<QuadCorners> quads;
        const LayerSolids& solids = columns_.solids();
        for (Index cell = 0; cell < plane_.cell_count(); ++cell) {
            if ((level > 0 && solids(cell, level - 1) != no_index) ||
                (level < solids.layers() && solids(cell, level) != no_index)) {
                const auto first = plane_.quads.begin() + static_cast<std::ptrdiff_t>(plane_.cell_quads[cell]);
                const auto last = plane_.quads.begin() + static_cast<std::ptrdiff_t>(plane_.cell_quads[cell + 1]);
                quads.insert(quads.end(), first, last);
            }
        }
        return quads;
    }

    void extend(double tolerance) {
        std::vector<char> known(columns_.nodes().levels(), 0);
        for (const std::vector<int>* list : {&levels_.caps, &levels_.curves}) {
            for (const int level : *list) {
                known[static_cast<std::size_t>(level)] = 1;
            }
        }
        for (std::size_t level = 0; level < known.size(); ++level) {
            if (known[level] != 0) {
                extend_heights(
                    plane_.nodes, sheet(level), tolerance,
                    [&](Index p) {
                        const Index node = columns_.nodes()(p, level);
                        return how_[node] == NodePlace::none ? std::nullopt : std::optional(places_[node][2]);
                    },
                    [&](Index p, double height) {
                        const Index node = columns_.nodes()(p, level);
                        put(node, {places_[node][0], places_[node][1], height}, NodePlace::extended);
                    });
            }
        }
    }

    void fill() {
        for (Index p = 0; p < plane_.nodes.size(); ++p) {
            for_runs(p, [&](std::size_t first, std::size_t last) {
                fill_column(p, first, last, columns_.nodes(), places_, how_);
            });
        }
    }

    const ExtrudedBody& body_;
    const G& geometry_;
    const ImprintedBody& imprinted_;
    const PlaneMesh& plane_;
    const ColumnLevels& levels_;
    ColumnBuilder& columns_;
    std::vector<Vec3>& places_;
    std::vector<NodePlace> how_;
};

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
inline SmoothReport smooth_columns(ColumnMesh& mesh, const Execution& execution) {
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

/// Intervals and quads of the plane; where no quads fit into a cell its edges are divided more finely, a few times.
template <extruded_geometry G, class Solver, class M>
[[nodiscard]] PlaneMesh mesh_imprinted(const ExtrudedBody& body, const G& geometry, const ImprintedBody& imprinted,
                                       const MultiSweepOptions& options, Solver&& solver, M&& mesher,
                                       MultiSweepReport& report) {
    constexpr int tries = 7;
    const PlaneArrangement& plane = imprinted.plane;
    const auto curves = curves_of_edges(plane);
    std::vector<double> sizes = edge_sizes(body, plane, options.size);
    std::vector<char> wanted;
    for (const CellStack& stack : imprinted.stacks) {
        wanted.push_back(static_cast<char>(!stack.caps.empty()));
    }
    const auto place = [&](Index edge, const Vec2& x) {
        return Vec2(geometry.curve_point(curves[edge].front(), x).template head<2>());
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
                        sizes[use.edge] *= 0.7;
                    }
                }
            });
        if (failures == 0) {
            return mesh;
        }
        report.refined_cells += failures;
    }
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

}  // namespace detail

/// Fills \p body with hexahedra. The curves of all its caps are projected into the plane normal to the direction and
/// imprinted into one arrangement, whose cells are divided into quads; over each cell the solid reaches from cap to cap.
/// Every cap is a level of nodes: the levels run through the whole solid, and an integer program spreads the layers
/// between them. Nodes of caps, curves and vertices lie on them, those of sides straight between; inner levels keep the
/// height of their caps where these are flat and follow them smoothly where they are not.
///
/// \p imprint makes arrangements (plane_imprinter), \p solver solves integer programs (e.g. `solve`), \p mesher fills
/// plane regions with quads (region_mesher). The result is not verified; use verify_hexes(). Deterministic if these
/// are. O(hexahedra) memory and time, but for the solver, and for levels whose caps are not of one height.
/// \throws UnmeshableError not_sweepable naming faces (tags) that are too narrow or have no level;
/// infeasible_intervals; InputError bad_option, empty_input, size_mismatch; what the callables throw
template <extruded_geometry G, plane_imprinter I, class Solver, region_mesher M>
[[nodiscard]] MultiSweepMesh multi_sweep(const ExtrudedBody& body, const G& geometry, const MultiSweepOptions& options,
                                         I&& imprint, Solver&& solver, M&& mesher) {
    detail::check_multi_sweep(body, options);
    report(options.progress, "imprinting", 0);
    const detail::ImprintedBody imprinted = detail::imprint_body(body, geometry, options, imprint);
    const double tolerance = 1e-6 * (detail::height_range(body) + options.size);
    report(options.progress, "intervals", 0.2);
    MultiSweepReport done;
    const ColumnLevels levels =
        column_levels(body, geometry, imprinted.plane, imprinted.stacks, options.size,
                      LevelTolerance{tolerance, std::max(tolerance, 4 * imprinted.merge)}, solver);
    done.optimal = levels.optimal;
    done.worst_layer_ratio = levels.worst_ratio;
    report(options.progress, "quads", 0.3);
    const PlaneMesh plane = detail::mesh_imprinted(body, geometry, imprinted, options, solver, mesher, done);
    report(options.progress, "layers", 0.6);
    detail::ColumnBuilder columns(body, imprinted.plane, plane, imprinted.stacks, levels);
    detail::ColumnPlacer<G>(body, geometry, imprinted, plane, levels, columns).place(1e-3 * tolerance);
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
