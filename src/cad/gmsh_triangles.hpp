#pragma once
// Triangles by Gmsh's own mesher of surfaces. Internal to the cad component.

#include "raw_surface.hpp"

namespace pavior::detail {

/// Triangulates the current model, ever finer as a whole until the chord is met; leaves no mesh in it. Isotropic on
/// curved faces; plane ones get the nodes of their curves alone unless the options ask for a size.
/// \throws Error cad_failure
RawSurface gmsh_triangles(const TriangulationOptions& options);

/// The largest distance of edge middles and triangle centres from their faces that is asked for in the current model.
double wanted_chord(const TriangulationOptions& options);

}  // namespace pavior::detail
