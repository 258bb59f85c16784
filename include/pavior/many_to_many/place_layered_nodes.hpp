#pragma once
/// \file
/// Where the nodes of columns of hexahedra lie.

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/caps_over_cells.hpp>
#include <pavior/many_to_many/column_heights.hpp>
#include <pavior/many_to_many/detail/layered_hex_builder.hpp>
#include <pavior/many_to_many/level_program.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Puts nodes on the caps, curves and vertices of a body, and all others between them.
class LayeredNodePlacer {
public:
    LayeredNodePlacer(const ExtrudedBody& body, const AnyExtrudedGeometry& geometry,
                      const PlaneArrangement& arrangement, const std::vector<CapsOverCell>& stacks,
                      const PlaneMesh& plane, const CapLevels& levels, LayeredHexBuilder& columns)
        : body_(body),
          geometry_(geometry),
          arrangement_(arrangement),
          stacks_(stacks),
          plane_(plane),
          levels_(levels),
          columns_(columns),
          places_(columns.result().mesh.nodes),
          how_(places_.size(), NodePlace::none) {}

    /// \p tolerance: heights closer than this are equal.
    void place(double tolerance) {
        place_curves(1e3 * tolerance);
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
            for (const Index c : stacks_[cell].caps) {
                for (std::size_t q = plane_.cell_quads[cell]; q < plane_.cell_quads[cell + 1]; ++q) {
                    for (const Index p : plane_.quads[q]) {
                        const Index node = id(p, levels_.caps[c]);
                        if (node == no_index) {
                            throw UnmeshableError(ErrorCode::not_sweepable,
                                                  "face " + std::to_string(body_.caps[c].tag) +
                                                      " bounds a part of the solid that has no height",
                                                  {body_.caps[c].tag});
                        }
                        if (how_[node] == NodePlace::none) {
                            const Vec2 at = places_[node].head<2>();
                            put(node, {at[0], at[1], geometry_.cap_height(c, at)}, NodePlace::cap);
                        }
                    }
                }
            }
        }
    }

    void place_curves(double tolerance) {
        for (Index c = 0; c < body_.curves.size(); ++c) {
            for (const OrientedPlaneEdge& use : arrangement_.routes[c]) {
                for (const Index p : plane_.edges[use.edge]) {
                    put(id(p, levels_.curves[c]), geometry_.curve_point(c, plane_.nodes[p]), NodePlace::exact);
                }
            }
        }
        for (Index c = 0; c < body_.curves.size(); ++c) {
            for (std::size_t k = 0; k < 2; ++k) {
                const Index v = body_.curves[c].vertices[k];
                const Index node = id(arrangement_.ends[c][k], levels_.vertices[v]);
                if (node != no_index && how_[node] == NodePlace::vertex &&
                    (places_[node] - body_.vertices[v]).norm() > tolerance) {
                    throw UnmeshableError(
                        ErrorCode::not_sweepable,
                        "a vertex of edge " + std::to_string(body_.curves[c].tag) + " falls together with another one");
                }
                put(node, body_.vertices[v], NodePlace::vertex);
            }
        }
        place_ribs();
    }

    /// Given nodes between the ends of edges along the direction.
    void place_ribs() {
        const std::vector<Index> at = body_.ribs.empty() ? std::vector<Index>{} : plane_vertices(body_, arrangement_);
        for (const ExtrudedRib& rib : body_.ribs) {
            for (std::size_t i = 1; i + 1 < rib.vertices.size(); ++i) {
                const Index v = rib.vertices[i];
                put(id(at[rib.vertices.front()], levels_.vertices[v]), body_.vertices[v], NodePlace::vertex);
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
                    shift.row(p) = (places_[node].head<2>() - plane_.nodes[p]).transpose();
                }
            }
            if (shift.cwiseAbs().maxCoeff() <= tolerance) {
                continue;
            }
            const Eigen::MatrixX2d inner = laplace.solve(shift);
            for (auto p = static_cast<Index>(plane_.edge_nodes); p < plane_.nodes.size(); ++p) {
                if (const Index node = columns_.nodes()(p, level); node != no_index) {
                    const auto row = static_cast<Eigen::Index>(p - plane_.edge_nodes);
                    places_[node].head<2>() += inner.row(row).transpose();
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
            if (how_[node(level)] < NodePlace::exact) {
                const Vec2 at = below ? Vec2(places_[node(*below)].head<2>()) : plane_.nodes[p];
                places_[node(level)].head<2>() = at;
                continue;
            }
            const Vec2 to = places_[node(level)].head<2>();
            farthest = std::max(farthest, (to - plane_.nodes[p]).norm());
            const std::size_t start = below.value_or(first);
            const Vec2 from = below ? Vec2(places_[node(*below)].head<2>()) : to;
            for (std::size_t k = below ? start + 1 : start; k < level; ++k) {
                const double t = static_cast<double>(k - start) / static_cast<double>(level - start);
                places_[node(k)].head<2>() = (1 - t) * from + t * to;
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
    const AnyExtrudedGeometry& geometry_;
    const PlaneArrangement& arrangement_;
    const std::vector<CapsOverCell>& stacks_;
    const PlaneMesh& plane_;
    const CapLevels& levels_;
    LayeredHexBuilder& columns_;
    std::vector<Vec3>& places_;
    std::vector<NodePlace> how_;
};

}  // namespace pavior::detail
