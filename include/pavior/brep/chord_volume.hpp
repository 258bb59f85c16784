#pragma once
/// \file
/// How much volume lies between quads and the curved faces that they stand for.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/face_distance.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace pavior {

namespace detail {

/// The largest distance of nine points of the bilinear quad from the surface of the face.
template <brep B>
[[nodiscard]] double quad_distance(const B& body, FaceId face, const std::array<Vec3, 4>& x) {
    double most = 0.0;
    for (const double u : {0.0, 0.5, 1.0}) {
        for (const double v : {0.0, 0.5, 1.0}) {
            const Vec3 at = (1 - v) * ((1 - u) * x[0] + u * x[1]) + v * ((1 - u) * x[3] + u * x[2]);
            most = std::max(most, (body.face_point(face, body.closest_on_face(face, at)) - at).norm());
        }
    }
    return most;
}

[[nodiscard]] inline double quad_area(const std::array<Vec3, 4>& x) {
    return 0.5 * ((x[1] - x[0]).cross(x[2] - x[0]).norm() + (x[2] - x[0]).cross(x[3] - x[0]).norm());
}

}  // namespace detail

/// An upper estimate of the volume between \p quads and the faces they lie on: the sum of area times distance, half as
/// much again. A mesh whose boundary nodes are on the faces differs in volume from the solid by no more. Quads on flat
/// faces need not be given.
/// \param faces   the face of each quad
/// \param enough  counting stops once the estimate reaches it
/// O(quads), nine closest points each. \throws InputError size_mismatch
template <brep B>
[[nodiscard]] double chord_volume(const B& body, std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                  std::span<const FaceId> faces,
                                  double enough = std::numeric_limits<double>::infinity()) {
    detail::check_quad_faces(quads, faces);
    constexpr double margin = 1.5;
    double volume = 0.0;
    for (std::size_t q = 0; q < quads.size() && !(volume >= enough); ++q) {
        const std::array<Vec3, 4> x{nodes[quads[q][0]], nodes[quads[q][1]], nodes[quads[q][2]], nodes[quads[q][3]]};
        volume += margin * detail::quad_area(x) * detail::quad_distance(body, faces[q], x);
    }
    return volume;
}

}  // namespace pavior
