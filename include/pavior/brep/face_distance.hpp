#pragma once
/// \file
/// How far the boundary nodes of a mesh are from the faces that they stand for.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// \throws InputError size_mismatch unless each quad has a face
PAVIOR_INLINE void check_quad_faces(std::span<const QuadCorners> quads, std::span<const FaceId> faces);

}  // namespace detail

/// The node farthest from the surface of the face that its quad lies on.
struct FaceDistance {
    double distance = 0.0;
    std::size_t quad = 0;
    Index node = 0;
};

/// The node of \p quads that is farthest from the face of its quad, the first of several equal ones; distance 0 without
/// quads.
/// \param faces  the face of each quad
/// O(quads); one closest point a node where the quads of a face come one after the other.
/// \throws InputError size_mismatch
template <brep B>
[[nodiscard]] FaceDistance face_distance(const B& body, std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                         std::span<const FaceId> faces) {
    detail::check_quad_faces(quads, faces);
    FaceDistance farthest;
    std::vector<FaceId> seen(nodes.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        for (const Index i : quads[q]) {
            if (std::exchange(seen[i], faces[q]) == faces[q]) {
                continue;
            }
            const Vec3& x = nodes[i];
            const double distance = (body.face_point(faces[q], body.closest_on_face(faces[q], x)) - x).norm();
            if (distance > farthest.distance) {
                farthest = {distance, q, i};
            }
        }
    }
    return farthest;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/face_distance-inl.hpp>
#endif
