#pragma once
/// \file
/// How much volume lies between quads and the curved faces that they stand for.

#include <pavior/brep/boundary_deviation.hpp>
#include <pavior/brep/brep.hpp>
#include <pavior/mesh/cells.hpp>

#include <limits>
#include <span>

namespace pavior {

/// An upper estimate of the volume between \p quads and the faces they lie on: BoundaryDeviation::volume. Quads on flat
/// faces need not be given.
/// \param faces   the face of each quad
/// \param enough  counting stops once the estimate reaches it
/// Cost and errors as for boundary_deviation().
template <brep B>
[[nodiscard]] double chord_volume(const B& body, std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                  std::span<const FaceId> faces,
                                  double enough = std::numeric_limits<double>::infinity()) {
    const auto go_on = [&](const BoundaryDeviation& so_far) { return !(so_far.volume >= enough); };
    return boundary_deviation(body, nodes, quads, faces, go_on).volume;
}

}  // namespace pavior
