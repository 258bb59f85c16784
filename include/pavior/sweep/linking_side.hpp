#pragma once
/// \file
/// The structured mesh of one linking side of a sweep: on its surface, or in space where there is none.

#include <pavior/core/compiled.hpp>
#include <pavior/math/any_surface.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>
#include <pavior/sweep/transfinite.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace pavior {

/// How the inner nodes of a linking side were placed.
enum class LinkingWay : std::uint8_t {
    space,          ///< transfinite interpolation in space, no surface
    parameter,      ///< transfinite interpolation in the parameter plane, then the surface
    closest_point,  ///< transfinite interpolation in space, then the closest point of the surface
    lattice,        ///< no rectangle, but a union of them: a harmonic map (one_to_one/mesh_linking_side.hpp)
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

/// Parameters of a point of the surface next to a point in space; empty: nobody knows.
using ClosestParameters = std::function<Vec2(const Vec3&)>;

/// Mesh of a linking side without a surface: transfinite interpolation in space (transfinite.hpp has the errors).
/// The side nodes are copied bit by bit; folded quads are reported, not repaired. O(M R); thread-safe.
[[nodiscard]] PAVIOR_INLINE LinkingSideMesh linking_side(const GridSides<Vec3>& sides,
                                                         const LinkingSideOptions& options = {});

/// Mesh of a linking side on its surface, section 4.2.3 \cite roca2009. Interpolates the parameters of the sides
/// (transfinite.hpp), and evaluates the surface: inner nodes are surface.point(uv) exactly, the side nodes are the
/// given ones bit by bit. If quads fold (folded_quads.hpp) and `repair` is set: the interpolation in space moved to the
/// closest points is taken where fewer quads fold, then what is left is untangled on the surface with the sides fixed.
/// \param sides    nodes of the four sides in space
/// \param uv_sides their parameters, continuous across the seam of a periodic surface (see unwrap_sides())
/// \param surface  any parametric_surface
/// \param closest  parameters of the closest point of the surface, or empty
/// InputError: as transfinite(), for either set of sides; size_mismatch if the two differ. Quads that stay folded are
/// reported. O(M R) evaluations unless quads fold. As thread-safe as the surface.
[[nodiscard]] PAVIOR_INLINE LinkingSideMesh linking_side(const AnySurface& surface, const GridSides<Vec3>& sides,
                                                         const GridSides<Vec2>& uv_sides,
                                                         const LinkingSideOptions& options = {},
                                                         const ClosestParameters& closest = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/linking_side-inl.hpp>
#endif
