#pragma once
/// \file
/// What some models know beyond the brep concept, and what stands in for it where they do not.

#include <pavior/brep/brep.hpp>
#include <pavior/math/box.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pavior {

struct FacePlane {
    Vec3 point, normal;  ///< unit normal, the face's own
};

/// b.face_plane(f), or the plane of a face that b.face_kind(f) calls "Plane", through the point at b.face_interior(f);
/// nothing for other faces and for models without these.
template <brep B>
[[nodiscard]] std::optional<FacePlane> plane_of(const B& b, FaceId face) {
    if constexpr (requires { b.face_plane(face); }) {
        return b.face_plane(face);
    } else if constexpr (requires {
                             b.face_kind(face) == "Plane";
                             b.face_interior(face);
                         }) {
        if (b.face_kind(face) == "Plane") {
            const Vec2 uv = b.face_interior(face);
            const auto [du, dv] = b.face_derivatives(face, uv);
            return FacePlane{b.face_point(face, uv), du.cross(dv).normalized()};
        }
    }
    return std::nullopt;
}

/// Whether b.face_kind(f) is "Plane"; false where the model does not tell.
template <brep B>
[[nodiscard]] bool is_plane(const B& b, FaceId face) {
    if constexpr (requires { b.face_kind(face) == "Plane"; }) {
        return b.face_kind(face) == "Plane";
    }
    return false;
}

/// b.solid_volume(solid), or nothing where the model does not know it.
template <brep B>
[[nodiscard]] std::optional<double> volume_of(const B& b, SolidId solid) {
    if constexpr (requires { b.solid_volume(solid); }) {
        return b.solid_volume(solid);
    }
    return std::nullopt;
}

/// b.diagonal(), or the diagonal of the box round the middles and ends of all edges.
template <brep B>
[[nodiscard]] double diagonal_of(const B& b) {
    if constexpr (requires { b.diagonal(); }) {
        return b.diagonal();
    } else {
        Box<Vec3> box;
        for (std::int32_t e = 0; e < static_cast<std::int32_t>(b.edge_count()); ++e) {
            const auto range = b.edge_range(EdgeId{e});
            for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                box.add(b.edge_point(EdgeId{e}, range[0] + part * (range[1] - range[0])));
            }
        }
        return box.diagonal();
    }
}

/// The faces of \p b by the numbers that users know them by.
template <brep B>
[[nodiscard]] std::map<int, FaceId> faces_by_tag(const B& b) {
    std::map<int, FaceId> faces;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(b.face_count()); ++f) {
        faces.emplace(b.tag(2, FaceId{f}.index()), FaceId{f});
    }
    return faces;
}

/// The name of a face or solid in the file; empty where it has none.
template <brep B>
[[nodiscard]] std::string name_of(const B& b, FaceId face) {
    if constexpr (requires { std::string(b.face_name(face)); }) {
        return std::string(b.face_name(face));
    }
    return {};
}
template <brep B>
[[nodiscard]] std::string name_of(const B& b, SolidId solid) {
    if constexpr (requires { std::string(b.solid_name(solid)); }) {
        return std::string(b.solid_name(solid));
    }
    return {};
}

}  // namespace pavior
