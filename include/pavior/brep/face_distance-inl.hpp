#pragma once

#include <pavior/brep/face_distance.hpp>
#include <pavior/core/error.hpp>

#include <span>
#include <string>

namespace pavior {

namespace detail {

PAVIOR_INLINE void check_quad_faces(std::span<const QuadCorners> quads, std::span<const FaceId> faces) {
    if (quads.size() != faces.size()) {
        throw InputError(ErrorCode::size_mismatch, std::to_string(quads.size()) + " quads, but " +
                                                       std::to_string(faces.size()) + " faces of quads");
    }
}

}  // namespace detail

}  // namespace pavior
