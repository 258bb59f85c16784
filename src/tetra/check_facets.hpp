#pragma once
// check_surface() for a boundary with walls inside. Internal to the tetra component.

#include <pavior/tetra/check_surface.hpp>

namespace pavior::detail {

/// The first \p boundary facets must bound solids; the others may end and meet where they like, but must neither
/// intersect nor repeat any facet. In the report inner facet i is triangle boundary + i.
[[nodiscard]] SurfaceReport check_facets(std::span<const Vec3> nodes, std::span<const TriCorners> facets,
                                         std::size_t boundary);

}  // namespace pavior::detail
