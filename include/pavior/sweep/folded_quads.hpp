#pragma once
/// \file
/// Folded quads of a mesh on a parametric surface, in a parameter plane, or on a structured grid in space.

#include <pavior/core/compiled.hpp>
#include <pavior/math/any_surface.hpp>
#include <pavior/math/point.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/sweep/transfinite.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// A quad is folded if the scaled determinant (sine of the angle) of one of its corners is not above this.
inline constexpr double folded_determinant = 1e-12;

namespace detail {

template <class Points>
[[nodiscard]] bool folded(const Points& x, const std::array<double, 4>& areas) {
    for (std::size_t c = 0; c < 4; ++c) {
        const double lengths = (x[(c + 1) % 4] - x[c]).norm() * (x[(c + 3) % 4] - x[c]).norm();
        if (!(areas[c] > folded_determinant * lengths)) {
            return true;
        }
    }
    return false;
}

template <class P>
[[nodiscard]] std::array<P, 4> gather(std::span<const P> nodes, const QuadCorners& q) {
    return {nodes[q[0]], nodes[q[1]], nodes[q[2]], nodes[q[3]]};
}

}  // namespace detail

/// Signed area of a closed polygon, positive if it runs counter-clockwise. O(n).
[[nodiscard]] PAVIOR_INLINE double signed_area(std::span<const Vec2> polygon);

/// Ids of the quads folded in the plane; they should run counter-clockwise, clockwise if \p reversed. O(quads).
[[nodiscard]] PAVIOR_INLINE std::vector<Index> folded_plane_quads(std::span<const Vec2> uv,
                                                                  std::span<const QuadCorners> quads,
                                                                  bool reversed = false);

/// Ids of the quads folded on a surface, in space: seen from the surface's normal in the middle of the quad (the other
/// side if \p reversed). Where the surface has no normal the parameter plane decides.
/// \param nodes positions of the nodes, those of \p uv on the surface
/// O(quads), one evaluation of derivatives each.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> folded_surface_quads(const AnySurface& surface,
                                                                    std::span<const Vec3> nodes,
                                                                    std::span<const Vec2> uv,
                                                                    std::span<const QuadCorners> quads,
                                                                    bool reversed = false);

/// Ids of the quads of a grid in space that fold as far as one can tell without a surface: a corner is inverted as seen
/// from the quad's own normal, or that normal is nearly opposite to those of all its neighbours. O(quads).
[[nodiscard]] PAVIOR_INLINE std::vector<Index> folded_grid_quads(const StructuredGrid<Vec3>& grid);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/folded_quads-inl.hpp>
#endif
