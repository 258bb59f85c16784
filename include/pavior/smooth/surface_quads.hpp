#pragma once
/// \file
/// Untangles and optimises quads on a parametric surface, boundary fixed.

#include <pavior/core/compiled.hpp>
#include <pavior/math/any_surface.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <cstdint>
#include <span>

namespace pavior {

/// Moves nodes in the parameter plane of a surface until no quad is folded, neither there nor in space seen from the
/// tip of the surface's normal in the middle of the quad. As untangle_quads(), lengths and angles measured in space:
/// the distortion uses the first fundamental form at each corner triangle, so that the parameters may be scaled and
/// skewed at will (a cylinder of radius 100 with u in radians and v in millimetres). Nodes stay on the surface.
///
/// Only what needs to be moved is moved, and the result is never worse than the input, as in untangle_quads().
/// \param surface    any parametric_surface psi(u, v); its normal is d/du x d/dv. Called from one thread only, about 5
///                   times per quad freed and step of epsilon. It need not be defined outside the box of the fixed
///                   nodes' parameters.
/// \param uv         parameters of the nodes, in and out; on a periodic surface unwrapped, without a jump in a quad.
/// \param quads      corners, counter-clockwise about the normal and so in the parameter plane; the other way round
///                   with options.reversed.
/// \param fixed      one flag per node; 0: may move. Fixed nodes do not change by a bit. As a rule the boundary.
/// \param reference_nodes  empty, or one point in space per node: the shape each quad should take, e.g. the source cap;
///                   any scale and position. Empty: squares of the mean area.
/// \return the report; its determinants are those in space. A quad that is folded by fixed nodes alone is reported.
/// \throws InputError size_mismatch, bad_index, not_finite, bad_option; Stopped; what the surface throws. The
/// parameters are as they were then.
PAVIOR_INLINE SmoothReport untangle_surface_quads(const AnySurface& surface, std::span<Vec2> uv,
                                                  std::span<const QuadCorners> quads,
                                                  std::span<const std::uint8_t> fixed,
                                                  const UntangleOptions& options = {},
                                                  std::span<const Vec3> reference_nodes = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/smooth/surface_quads-inl.hpp>
#endif
