#pragma once
/// \file
/// Transfinite interpolation of a structured grid from its four sides.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/box.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// A structured grid of M x R quads: node (i, k), 0 <= i <= M, 0 <= k <= R, is nodes[k * (M + 1) + i], row by row.
/// Quad (i, k) has id k * M + i and the corners (i, k), (i+1, k), (i+1, k+1), (i, k+1).
/// \tparam P a fixed-size Eigen vector, e.g. Vec3 (space) or Vec2 (parameter plane).
template <class P>
struct StructuredGrid {
    std::size_t columns = 0;  ///< M, intervals along a row
    std::size_t rows = 0;     ///< R, intervals along a column
    std::vector<P> nodes;     ///< (M + 1)(R + 1) of them, row by row

    StructuredGrid() = default;
    StructuredGrid(std::size_t m, std::size_t r) : columns(m), rows(r), nodes((m + 1) * (r + 1), P::Zero()) {}

    [[nodiscard]] std::size_t index(std::size_t i, std::size_t k) const { return k * (columns + 1) + i; }
    [[nodiscard]] P& operator()(std::size_t i, std::size_t k) { return nodes[index(i, k)]; }
    [[nodiscard]] const P& operator()(std::size_t i, std::size_t k) const { return nodes[index(i, k)]; }
    [[nodiscard]] std::span<const P> row(std::size_t k) const {
        return std::span(nodes).subspan(index(0, k), columns + 1);
    }
};

/// Corner ids of the quads of an M x R grid in the order of their ids.
[[nodiscard]] PAVIOR_INLINE std::vector<QuadCorners> structured_quads(std::size_t columns, std::size_t rows);

/// The four sides of a grid. bottom and top run with i (M + 1 nodes), left and right with k (R + 1 nodes):
///
///      left[R] = top[0] --- top[M] = right[R]
///          |                        |
///     left[0] = bottom[0] - bottom[M] = right[0]
template <class P>
struct GridSides {
    std::span<const P> bottom;
    std::span<const P> top;
    std::span<const P> left;
    std::span<const P> right;
};

/// Where a node of the grid sits in the unit square of the interpolation.
enum class Blending : std::uint8_t {
    uniform,     ///< xi_i = i / M, eta_k = k / R
    arc_length,  ///< mean relative arc length of the two opposite sides; uniform where both have length 0
};

struct TransfiniteOptions {
    Blending blending = Blending::uniform;
    /// Largest distance of two ends that should be one corner, relative to the extent of the sides.
    double corner_tolerance = 1e-8;
};

namespace detail {

template <class P>
[[nodiscard]] double sides_extent(const GridSides<P>& sides) {
    Box<P> box;
    for (const std::span<const P> side : {sides.bottom, sides.top, sides.left, sides.right}) {
        for (const P& p : side) {
            box.add(p);
        }
    }
    return box.diagonal();
}

template <class P>
void check_sides_shape(const GridSides<P>& sides) {
    if (sides.bottom.size() < 2 || sides.left.size() < 2) {
        throw InputError(ErrorCode::empty_input, "each side of a grid needs at least two nodes");
    }
    if (sides.bottom.size() != sides.top.size()) {
        throw InputError(ErrorCode::size_mismatch, "bottom has " + std::to_string(sides.bottom.size()) +
                                                       " nodes and top " + std::to_string(sides.top.size()));
    }
    if (sides.left.size() != sides.right.size()) {
        throw InputError(ErrorCode::size_mismatch, "left has " + std::to_string(sides.left.size()) +
                                                       " nodes and right " + std::to_string(sides.right.size()));
    }
    for (const std::span<const P> side : {sides.bottom, sides.top, sides.left, sides.right}) {
        if (!std::all_of(side.begin(), side.end(), [](const P& p) { return p.allFinite(); })) {
            throw InputError(ErrorCode::not_finite, "a side of a grid has a node that is not finite");
        }
    }
}

template <class P>
void check_sides(const GridSides<P>& sides, double corner_tolerance) {
    check_sides_shape(sides);
    const std::array<std::pair<const P*, const P*>, 4> corners{{{&sides.bottom.front(), &sides.left.front()},
                                                                {&sides.bottom.back(), &sides.right.front()},
                                                                {&sides.top.back(), &sides.right.back()},
                                                                {&sides.top.front(), &sides.left.back()}}};
    const double allowed = corner_tolerance * sides_extent(sides);
    Error::Ids bad;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if (!((*corners[c].first - *corners[c].second).stableNorm() <= allowed)) {
            bad.push_back(static_cast<std::int64_t>(c));
        }
    }
    if (!bad.empty()) {
        throw InputError(ErrorCode::inconsistent_boundary, "sides do not meet at a corner of the grid", std::move(bad));
    }
}

/// Adds half the relative arc length of \p side at each node to \p sum; nothing and false if its length is 0.
template <class P>
bool add_relative_arc_length(std::span<const P> side, std::vector<double>& sum) {
    std::vector<double> length(side.size(), 0.0);
    for (std::size_t i = 1; i < side.size(); ++i) {
        length[i] = length[i - 1] + (side[i] - side[i - 1]).stableNorm();
    }
    if (!(length.back() > 0.0)) {
        return false;
    }
    for (std::size_t i = 0; i < side.size(); ++i) {
        sum[i] += length[i] / length.back();
    }
    return true;
}

template <class P>
[[nodiscard]] std::vector<double> blending_parameters(std::span<const P> a, std::span<const P> b, Blending blending) {
    std::vector<double> t(a.size(), 0.0);
    int used = 0;
    if (blending == Blending::arc_length) {
        used = static_cast<int>(add_relative_arc_length(a, t)) + static_cast<int>(add_relative_arc_length(b, t));
    }
    for (std::size_t i = 0; i < t.size(); ++i) {
        t[i] = used != 0 ? t[i] / used : static_cast<double>(i) / static_cast<double>(t.size() - 1);
    }
    return t;
}

}  // namespace detail

/// Transfinite interpolation (bilinearly blended Coons patch) \cite haber1981 of a grid from its four sides:
///
///     x(i,k) = (1-eta) bottom_i + eta top_i + (1-xi) left_k + xi right_k
///              - (1-xi)(1-eta) c_00 - xi (1-eta) c_M0 - (1-xi) eta c_0R - xi eta c_MR
///
/// with xi, eta as in Blending. The side nodes are copied bit by bit (corners from bottom and top). The grid may fold
/// where the sides are strongly curved. Sides of length 0 (a triangle) are allowed.
/// InputError: empty_input (a side with fewer than two nodes), size_mismatch (opposite sides), not_finite,
/// inconsistent_boundary (ids: corners, 0 bottom left, then counter-clockwise). O(M R); thread-safe.
template <class P>
[[nodiscard]] StructuredGrid<P> transfinite(const GridSides<P>& sides, const TransfiniteOptions& options = {}) {
    detail::check_sides(sides, options.corner_tolerance);
    StructuredGrid<P> grid(sides.bottom.size() - 1, sides.left.size() - 1);
    const std::size_t m = grid.columns;
    const std::size_t r = grid.rows;
    const std::vector<double> xi = detail::blending_parameters(sides.bottom, sides.top, options.blending);
    const std::vector<double> eta = detail::blending_parameters(sides.left, sides.right, options.blending);
    for (std::size_t k = 1; k < r; ++k) {
        const double t = eta[k];
        const P low = sides.left[k] - (1.0 - t) * sides.bottom[0] - t * sides.top[0];
        const P high = sides.right[k] - (1.0 - t) * sides.bottom[m] - t * sides.top[m];
        for (std::size_t i = 1; i < m; ++i) {
            const double s = xi[i];
            grid(i, k) = (1.0 - t) * sides.bottom[i] + t * sides.top[i] + (1.0 - s) * low + s * high;
        }
        grid(0, k) = sides.left[k];
        grid(m, k) = sides.right[k];
    }
    for (std::size_t i = 0; i <= m; ++i) {
        grid(i, 0) = sides.bottom[i];
        grid(i, r) = sides.top[i];
    }
    return grid;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/transfinite-inl.hpp>
#endif
