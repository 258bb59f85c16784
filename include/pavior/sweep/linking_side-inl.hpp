#pragma once

#include <pavior/core/error.hpp>
#include <pavior/smooth/surface_quads.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/linking_side.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

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

inline void evaluate_inside(const AnySurface& surface, LinkingSideMesh& side) {
    for (std::size_t k = 1; k < side.uv.rows; ++k) {
        for (std::size_t i = 1; i < side.uv.columns; ++i) {
            side.nodes(i, k) = surface.point(side.uv(i, k));
        }
    }
}

[[nodiscard]] inline std::vector<Index> folded_quads(const AnySurface& surface, const LinkingSideMesh& side) {
    return folded_surface_quads(surface, std::span<const Vec3>(side.nodes.nodes), std::span<const Vec2>(side.uv.nodes),
                                structured_quads(side.uv.columns, side.uv.rows), side.reversed);
}

/// Do the sides run clockwise in the parameter plane?
[[nodiscard]] inline bool sides_reversed(const GridSides<Vec2>& sides) {
    std::vector<Vec2> loop(sides.bottom.begin(), sides.bottom.end());
    loop.insert(loop.end(), sides.right.begin(), sides.right.end());
    loop.insert(loop.end(), sides.top.rbegin(), sides.top.rend());
    loop.insert(loop.end(), sides.left.rbegin(), sides.left.rend());
    return signed_area(loop) < 0.0;
}

/// Moves the inner nodes of \p in_space to their closest points; kept if fewer quads fold than in \p side.
inline void try_closest_points(const AnySurface& surface, const ClosestParameters& closest,
                               const StructuredGrid<Vec3>& in_space, const Periods& periods, LinkingSideMesh& side) {
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
inline void untangle_side(const AnySurface& surface, const StructuredGrid<Vec3>& in_space, UntangleOptions options,
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

PAVIOR_INLINE LinkingSideMesh linking_side(const GridSides<Vec3>& sides, const LinkingSideOptions& options) {
    LinkingSideMesh side;
    side.nodes = transfinite(sides, options.transfinite);
    side.folded = folded_grid_quads(side.nodes);
    return side;
}

PAVIOR_INLINE LinkingSideMesh linking_side(const AnySurface& surface, const GridSides<Vec3>& sides,
                                           const GridSides<Vec2>& uv_sides, const LinkingSideOptions& options,
                                           const ClosestParameters& closest) {
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
    if (closest && options.repair && !side.folded.empty()) {
        detail::try_closest_points(surface, closest, in_space, options.periods, side);
    }
    if (options.repair && !side.folded.empty()) {
        detail::untangle_side(surface, in_space, options.untangle, side);
    }
    return side;
}

}  // namespace pavior
