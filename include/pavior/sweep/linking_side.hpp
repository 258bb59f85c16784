#pragma once
/// \file
/// The structured mesh of one linking side of a sweep: on its surface, or in space where there is none.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/parametric_surface.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/surface_quads.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/transfinite.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace pavior {

/// How the inner nodes of a linking side were placed.
enum class LinkingWay : std::uint8_t {
    space,          ///< transfinite interpolation in space, no surface
    parameter,      ///< transfinite interpolation in the parameter plane, then the surface
    closest_point,  ///< transfinite interpolation in space, then the closest point of the surface
    lattice,        ///< no rectangle, but a union of them: a harmonic map (model/mesh_linking_side.hpp)
};

/// "space", "parameter", "closest_point" or "lattice".
[[nodiscard]] constexpr std::string_view to_string(LinkingWay way) noexcept {
    switch (way) {
        case LinkingWay::space: return "space";
        case LinkingWay::parameter: return "parameter";
        case LinkingWay::closest_point: return "closest_point";
        case LinkingWay::lattice: return "lattice";
    }
    return "unknown";
}

struct LinkingSideOptions {
    /// Blending, and the tolerance of corners in space.
    TransfiniteOptions transfinite;
    /// Tolerance of corners in the parameter plane, relative to the extent of the sides there.
    double uv_corner_tolerance = 1e-6;
    /// Periods of the surface, to unwrap what `closest` returns.
    Periods periods{0.0, 0.0};
    /// If quads fold: try the closest points, then untangle. False: the interpolation in the parameter plane as it is.
    bool repair = true;
    /// How to untangle; `reversed` is set by the function.
    UntangleOptions untangle;
};

/// The mesh of a linking side and its report. Quad ids as in StructuredGrid.
struct LinkingSideMesh {
    StructuredGrid<Vec3> nodes;
    StructuredGrid<Vec2> uv;  ///< parameters of the nodes; no nodes without a surface
    LinkingWay way = LinkingWay::space;
    bool reversed = false;                ///< rows and columns run clockwise in the parameter plane
    std::vector<Index> folded_parameter;  ///< quads folded by the interpolation in the parameter plane
    SmoothReport smooth;                  ///< of the untangling; iterations 0 if there was none to do
    std::vector<Index> folded;            ///< quads still folded, ascending
};

/// A functor Vec3 -> Vec2: parameters of a point of the surface next to a point in space.
template <class F>
concept closest_point_function = requires(const F& f, const Vec3& x) {
    { f(x) } -> std::convertible_to<Vec2>;
};

/// Stands for "no closest point function".
struct NoClosestPoint {};

namespace detail {

/// Copies the sides into the border of \p grid, bit by bit.
template <class P>
void copy_border(const GridSides<P>& sides, StructuredGrid<P>& grid) {
    for (std::size_t k = 0; k <= grid.rows; ++k) {
        grid(0, k) = sides.left[k];
        grid(grid.columns, k) = sides.right[k];
    }
    for (std::size_t i = 0; i <= grid.columns; ++i) {
        grid(i, 0) = sides.bottom[i];
        grid(i, grid.rows) = sides.top[i];
    }
}

template <parametric_surface S>
void evaluate_inside(const S& surface, LinkingSideMesh& side) {
    for (std::size_t k = 1; k < side.uv.rows; ++k) {
        for (std::size_t i = 1; i < side.uv.columns; ++i) {
            side.nodes(i, k) = surface.point(side.uv(i, k));
        }
    }
}

template <parametric_surface S>
[[nodiscard]] std::vector<Index> folded_quads(const S& surface, const LinkingSideMesh& side) {
    return folded_surface_quads(surface, std::span<const Vec3>(side.nodes.nodes), std::span<const Vec2>(side.uv.nodes),
                                structured_quads(side.uv.columns, side.uv.rows), side.reversed);
}

/// Do the sides run clockwise in the parameter plane?
[[nodiscard]] PAVIOR_INLINE bool sides_reversed(const GridSides<Vec2>& sides);

/// Moves the inner nodes of \p in_space to their closest points; kept if fewer quads fold than in \p side.
template <parametric_surface S, closest_point_function Closest>
void try_closest_points(const S& surface, const Closest& closest, const StructuredGrid<Vec3>& in_space,
                        const Periods& periods, LinkingSideMesh& side) {
    LinkingSideMesh other = side;
    other.way = LinkingWay::closest_point;
    for (std::size_t k = 1; k < in_space.rows; ++k) {
        for (std::size_t i = 1; i < in_space.columns; ++i) {
            Vec2 uv = closest(in_space(i, k));
            uv += nearest_image_shift(uv, side.uv(i, k), periods);
            other.uv(i, k) = uv;
        }
    }
    evaluate_inside(surface, other);
    other.folded = folded_quads(surface, other);
    if (other.folded.size() < side.folded.size()) {
        side = std::move(other);
    }
}

/// Untangles on the surface, the border fixed; the shapes wanted are those of the interpolation in space.
template <parametric_surface S>
void untangle_side(const S& surface, const StructuredGrid<Vec3>& in_space, UntangleOptions options,
                   LinkingSideMesh& side) {
    const std::vector<QuadCorners> quads = structured_quads(side.uv.columns, side.uv.rows);
    std::vector<std::uint8_t> fixed(side.uv.nodes.size(), 1);
    for (std::size_t k = 1; k < side.uv.rows; ++k) {
        for (std::size_t i = 1; i < side.uv.columns; ++i) {
            fixed[side.uv.index(i, k)] = 0;
        }
    }
    options.reversed = side.reversed;
    LinkingSideMesh other = side;
    other.smooth =
        untangle_surface_quads(surface, std::span<Vec2>(other.uv.nodes), std::span<const QuadCorners>(quads),
                               std::span<const std::uint8_t>(fixed), options, std::span<const Vec3>(in_space.nodes));
    evaluate_inside(surface, other);
    other.folded = folded_quads(surface, other);
    if (other.folded.size() < side.folded.size()) {
        side = std::move(other);
    } else {
        side.smooth = std::move(other.smooth);
    }
}

}  // namespace detail

/// Mesh of a linking side without a surface: transfinite interpolation in space (transfinite.hpp has the errors).
/// The side nodes are copied bit by bit; folded quads are reported, not repaired. O(M R); thread-safe.
[[nodiscard]] PAVIOR_INLINE LinkingSideMesh linking_side(const GridSides<Vec3>& sides,
                                                         const LinkingSideOptions& options = {});

/// Mesh of a linking side on its surface, section 4.2.3 \cite roca2009. Interpolates the parameters of the sides
/// (transfinite.hpp), and evaluates the surface: inner nodes are surface.point(uv) exactly, the side nodes are the
/// given
/// ones bit by bit. If quads fold (folded_quads.hpp) and `repair` is set: the interpolation in space moved to the
/// closest points is taken where fewer quads fold, then what is left is untangled on the surface with the sides fixed.
/// \param sides    nodes of the four sides in space
/// \param uv_sides their parameters, continuous across the seam of a periodic surface (see unwrap_sides())
/// \param closest  optional functor Vec3 -> Vec2, parameters of the closest point of the surface
/// InputError: as transfinite(), for either set of sides; size_mismatch if the two differ. Quads that stay folded are
/// reported. O(M R) evaluations unless quads fold. As thread-safe as the surface.
template <parametric_surface S, class Closest = NoClosestPoint>
requires(closest_point_function<Closest> || std::same_as<Closest, NoClosestPoint>) [[nodiscard]] LinkingSideMesh
    linking_side(const S& surface, const GridSides<Vec3>& sides, const GridSides<Vec2>& uv_sides,
                 const LinkingSideOptions& options = {}, const Closest& closest = {}) {
    const StructuredGrid<Vec3> in_space = transfinite(sides, options.transfinite);
    LinkingSideMesh side;
    side.way = LinkingWay::parameter;
    side.uv = transfinite(uv_sides, {options.transfinite.blending, options.uv_corner_tolerance});
    if (side.uv.columns != in_space.columns || side.uv.rows != in_space.rows) {
        throw InputError(ErrorCode::size_mismatch, "the sides have different numbers of nodes and of parameters");
    }
    side.nodes = StructuredGrid<Vec3>(side.uv.columns, side.uv.rows);
    side.reversed = detail::sides_reversed(uv_sides);
    detail::copy_border(sides, side.nodes);
    detail::evaluate_inside(surface, side);
    side.folded_parameter = detail::folded_quads(surface, side);
    side.folded = side.folded_parameter;
    if constexpr (closest_point_function<Closest>) {
        if (options.repair && !side.folded.empty()) {
            detail::try_closest_points(surface, closest, in_space, options.periods, side);
        }
    }
    if (options.repair && !side.folded.empty()) {
        detail::untangle_side(surface, in_space, options.untangle, side);
    }
    return side;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/linking_side-inl.hpp>
#endif
