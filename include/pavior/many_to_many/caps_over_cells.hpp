#pragma once
/// \file
/// The caps over each cell of an arrangement, from bottom to top, and what is solid between them.

#include <pavior/core/compiled.hpp>
#include <pavior/many_to_many/extruded_body.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Caps over one cell by height: the solid between caps[i] and caps[i + 1] is that above caps[i], if there is one.
struct CapsOverCell {
    std::vector<Index> caps;
    std::vector<double> heights;  ///< of the caps over PlaneCell::inside
};

/// The stacks of all cells, or why there are none.
struct StackResult {
    std::vector<CapsOverCell> stacks;  ///< one a cell; empty where a fault was found
    std::string fault;                 ///< empty: none
    std::vector<int> tags;             ///< of the faces concerned
    std::vector<Index> curves;         ///< whose merging with others may be the reason
};

namespace detail {

/// How often the boundary of a cap runs along each edge, both senses together, as (edge, times).
[[nodiscard]] PAVIOR_INLINE std::vector<std::pair<Index, int>> boundary_edges(const PlaneArrangement& plane,
                                                                              const ExtrudedCap& cap);

/// Cells inside a closed boundary: those that an odd number of its edges parts from the outside.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> cells_inside(const PlaneArrangement& plane,
                                                            const std::vector<std::pair<Index, int>>& boundary);

/// The first fault of a stack: solids must begin and end at caps and not overlap.
[[nodiscard]] PAVIOR_INLINE StackResult check_stack(const ExtrudedBody& body, const CapsOverCell& stack);

/// Curves that shrank to a point, and caps that lost a part or all of their cells to the merging of curves.
[[nodiscard]] PAVIOR_INLINE StackResult check_cap(const PlaneArrangement& plane, const ExtrudedCap& cap,
                                                  const std::vector<std::pair<Index, int>>& boundary,
                                                  const std::vector<Index>& cells);

/// The solid over \p at, which lies in a cell or on its boundary, at some height; no_index: none.
template <extruded_geometry G>
[[nodiscard]] Index solid_at(const ExtrudedBody& body, const G& geometry, const CapsOverCell& stack, const Vec2& at,
                             double height) {
    Index solid = no_index;
    for (const Index c : stack.caps) {
        if (geometry.cap_height(c, at) < height) {
            solid = body.caps[c].above;
        }
    }
    return solid;
}

[[nodiscard]] inline Vec2 middle_point(const PlaneEdge& edge) {
    const std::size_t n = edge.points.size();
    return 0.5 * (edge.points[n / 2] + edge.points[(n - 1) / 2]);
}

/// A stretch of a side over an edge, between two of its curves.
struct SideStretch {
    Index edge;
    double low, high;
    const ExtrudedSide* side;
};

[[nodiscard]] inline StackResult side_fault(const ExtrudedSide& side, const std::string& what) {
    return {{}, "face " + std::to_string(side.tag) + ": " + what, {side.tag}, side.curves};
}

/// The stretches of a side over all edges. It runs over the same ones at its bottom and at its top.
template <extruded_geometry G>
[[nodiscard]] StackResult side_stretches(const G& geometry, const PlaneArrangement& plane, const ExtrudedSide& side,
                                         std::vector<SideStretch>& stretches) {
    std::vector<std::pair<Index, double>> at;
    for (const Index c : side.curves) {
        if (plane.routes[c].empty()) {
            return side_fault(side, "narrower than the tolerance");
        }
        for (const OrientedPlaneEdge& use : plane.routes[c]) {
            const Vec3 point = geometry.curve_point(c, middle_point(plane.edges[use.edge]));
            at.emplace_back(use.edge, point[2]);
        }
    }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0; i < at.size(); i += 2) {
        if (i + 1 == at.size() || at[i + 1].first != at[i].first) {
            return side_fault(side, "its upper and lower edges do not lie above each other");
        }
        stretches.push_back({at[i].first, at[i].second, at[i + 1].second, &side});
    }
    return {};
}

/// Every side must part a solid from something else, and no two may lie in one place: else a thin wall or slot between
/// two sides was lost.
template <extruded_geometry G>
[[nodiscard]] StackResult check_sides(const ExtrudedBody& body, const G& geometry, const PlaneArrangement& plane,
                                      const std::vector<CapsOverCell>& stacks) {
    std::vector<SideStretch> stretches;
    for (const ExtrudedSide& side : body.sides) {
        if (StackResult fault = side_stretches(geometry, plane, side, stretches); !fault.fault.empty()) {
            return fault;
        }
    }
    std::sort(stretches.begin(), stretches.end(), [](const SideStretch& a, const SideStretch& b) {
        return std::pair(a.edge, a.low) < std::pair(b.edge, b.low);
    });
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        const SideStretch& s = stretches[i];
        const double middle = 0.5 * (s.low + s.high);
        const double touching = s.low + 1e-3 * (s.high - s.low);
        if (i > 0 && stretches[i - 1].edge == s.edge && stretches[i - 1].high > touching) {
            return side_fault(*s.side,
                              "closer to face " + std::to_string(stretches[i - 1].side->tag) + " than the tolerance");
        }
        const auto solid = [&](Index cell) {
            return cell == no_index ? no_index
                                    : solid_at(body, geometry, stacks[cell], middle_point(plane.edges[s.edge]), middle);
        };
        if (solid(plane.edges[s.edge].cells[0]) == solid(plane.edges[s.edge].cells[1])) {
            return side_fault(*s.side, "the same on both of its sides within the tolerance");
        }
    }
    return {};
}

/// A point of a curve over a vertex of the arrangement.
struct VertexMark {
    Vec3 at;
    Index curve;
};

/// Per vertex of the arrangement: the points of the curves through it. Where a curve ends it is its vertex.
template <extruded_geometry G>
[[nodiscard]] std::vector<std::vector<VertexMark>> vertex_marks(const ExtrudedBody& body, const G& geometry,
                                                                const PlaneArrangement& plane) {
    std::vector<std::vector<VertexMark>> result(plane.vertices.size());
    for (Index c = 0; c < plane.routes.size(); ++c) {
        for (std::size_t i = 0; i < plane.routes[c].size(); ++i) {
            const OrientedPlaneEdge& use = plane.routes[c][i];
            const Index start = plane.edges[use.edge].vertices[use.forward ? 0 : 1];
            if (i > 0) {
                result[start].push_back({geometry.curve_point(c, plane.vertices[start]), c});
            }
        }
        for (std::size_t k = 0; k < 2; ++k) {
            result[plane.ends[c][k]].push_back({body.vertices[body.curves[c].vertices[k]], c});
        }
    }
    return result;
}

/// A curve that merged with a side must lie on it where it passes it between its bottom and its top, within \p limit:
/// else the side would be dented.
template <extruded_geometry G>
[[nodiscard]] StackResult check_dents(const ExtrudedBody& body, const G& geometry, const PlaneArrangement& plane,
                                      double limit) {
    const std::vector<std::vector<VertexMark>> marks = vertex_marks(body, geometry, plane);
    for (const ExtrudedSide& side : body.sides) {
        std::vector<std::pair<Index, VertexMark>> own;  // by vertex of the arrangement
        for (const Index c : side.curves) {
            for (const OrientedPlaneEdge& use : plane.routes[c]) {
                for (const Index v : plane.edges[use.edge].vertices) {
                    for (const VertexMark& mark : marks[v]) {
                        if (mark.curve == c) {
                            own.emplace_back(v, mark);
                        }
                    }
                }
            }
        }
        std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) {
            return std::pair(a.first, a.second.at[2]) < std::pair(b.first, b.second.at[2]);
        });
        for (std::size_t i = 0; i + 1 < own.size(); ++i) {
            const Vec3& low = own[i].second.at;
            const Vec3& high = own[i + 1].second.at;
            const double height = high[2] - low[2];
            for (const VertexMark& mark : marks[own[i].first]) {
                if (body.curves[mark.curve].face == side.tag && side.tag != 0) {
                    continue;  // a line of a mesh given on it
                }
                const double t = (mark.at[2] - low[2]) / height;
                if (own[i + 1].first == own[i].first && height > limit && t > 1e-6 && t < 1 - 1e-6 &&
                    (mark.at - (1 - t) * low - t * high).norm() > limit) {
                    StackResult fault = side_fault(
                        side, "closer to edge " + std::to_string(body.curves[mark.curve].tag) + " than the tolerance");
                    fault.curves.push_back(mark.curve);
                    return fault;
                }
            }
        }
    }
    return {};
}

}  // namespace detail

/// Finds the caps over each cell by counting the crossings of their boundaries (no geometry), orders them by their
/// heights over one point of the cell, and checks that solids lie between them. A fault means that the merging of
/// curves in \p plane destroyed something, or moved a point of a curve onto a side that it is farther from than \p
/// dent, or that the body is not closed. O(caps x cells + n log n).
template <extruded_geometry G>
[[nodiscard]] StackResult caps_over_cells(const ExtrudedBody& body, const G& geometry, const PlaneArrangement& plane,
                                          double dent = std::numeric_limits<double>::infinity()) {
    StackResult result;
    result.stacks.resize(plane.cells.size());
    for (Index c = 0; c < body.caps.size(); ++c) {
        const auto boundary = detail::boundary_edges(plane, body.caps[c]);
        const std::vector<Index> cells = detail::cells_inside(plane, boundary);
        if (StackResult fault = detail::check_cap(plane, body.caps[c], boundary, cells); !fault.fault.empty()) {
            return fault;
        }
        for (const Index cell : cells) {
            result.stacks[cell].caps.push_back(c);
        }
    }
    for (std::size_t cell = 0; cell < result.stacks.size(); ++cell) {
        CapsOverCell& stack = result.stacks[cell];
        std::vector<std::pair<double, Index>> order;
        for (const Index c : stack.caps) {
            order.emplace_back(geometry.cap_height(c, plane.cells[cell].inside), c);
        }
        std::sort(order.begin(), order.end());
        stack.caps.clear();
        for (const auto& [height, c] : order) {
            stack.caps.push_back(c);
            stack.heights.push_back(height);
        }
        if (StackResult fault = detail::check_stack(body, stack); !fault.fault.empty()) {
            return fault;
        }
    }
    if (StackResult fault = detail::check_sides(body, geometry, plane, result.stacks); !fault.fault.empty()) {
        return fault;
    }
    if (StackResult fault = detail::check_dents(body, geometry, plane, dent); !fault.fault.empty()) {
        return fault;
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/caps_over_cells-inl.hpp>
#endif
