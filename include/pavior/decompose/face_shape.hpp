#pragma once
/// \file
/// What surface a face lies on, found from its points and normals: planes, cylinders, surfaces of revolution.

#include <pavior/brep/brep.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/revolution.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pavior {

enum class FaceKind : std::uint8_t {
    plane,
    cylinder,
    revolved,  ///< round one axis: cones, tori, ...
    other,     ///< spheres, too: they have no axis of their own
};

struct FaceShape {
    FaceKind kind = FaceKind::other;
    Axis axis;            ///< of a plane: a point of it and its normal out of the solid
    double radius = 0;    ///< of a cylinder
    bool hollow = false;  ///< of cylinder and revolved: the material lies away from the axis, as round a hole
};

/// The shape of a face of a solid, to 1e-6 of its extent. O(edges of the face).
template <brep B>
[[nodiscard]] FaceShape face_shape(const B& b, const OrientedFace& f) {
    std::vector<std::pair<Vec3, Vec3>> samples;  // points and outward normals
    Vec3 middle = Vec3::Zero();
    detail::for_each_normal(b, f.face, [&](const Vec2& uv, const Vec3& normal) {
        samples.emplace_back(b.face_point(f.face, uv), f.outward ? normal : Vec3(-normal));
        middle += samples.back().first;
    });
    FaceShape shape;
    if (samples.empty()) {
        return shape;
    }
    middle /= static_cast<double>(samples.size());
    double scale = 0;
    bool plane = true;
    const Vec3 n = samples.front().second;
    for (const auto& [x, normal] : samples) {
        scale = std::max(scale, (x - middle).norm());
        plane = plane && (normal - n).norm() < 1e-6;
    }
    if (plane) {
        shape.kind = FaceKind::plane;
        shape.axis = {samples.front().first, n};
        return shape;
    }
    std::vector<Axis> axes;
    detail::add_axes(b, f.face, axes);
    if (axes.empty()) {
        return shape;
    }
    shape.kind = FaceKind::revolved;
    shape.axis = axes.front();
    double least = 1e300;
    double most = 0;
    double lean = 0;
    double away = 0;
    for (const auto& [x, normal] : samples) {
        const Vec3 arm =
            (x - shape.axis.origin) - (x - shape.axis.origin).dot(shape.axis.direction) * shape.axis.direction;
        least = std::min(least, arm.norm());
        most = std::max(most, arm.norm());
        lean = std::max(lean, std::abs(normal.dot(shape.axis.direction)));
        away += normal.dot(arm.normalized());
    }
    shape.hollow = away < 0;
    if (lean < 1e-6 && most - least < 1e-6 * (scale + most)) {
        shape.kind = FaceKind::cylinder;
        shape.radius = 0.5 * (least + most);
    }
    return shape;
}

}  // namespace pavior
