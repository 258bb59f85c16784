#pragma once

#include <pavior/part/block_model.hpp>
#include <pavior/part/model_extras.hpp>

#include <cmath>
#include <map>
#include <optional>

namespace pavior {

namespace detail {

/// Whether all faces are plane and two of them meet at an angle that the default limits would call smooth.
[[nodiscard]] inline bool has_shallow_crease(const AnyModel& b, SolidId solid) {
    std::map<EdgeId, Vec3> normals;
    bool crease = false;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        const std::optional<FacePlane> plane = plane_of(b, f.face);
        if (!plane) {
            return false;
        }
        const Vec3 normal = f.outward ? plane->normal : Vec3(-plane->normal);
        for (const EdgeLoop& loop : b.face_loops(f.face)) {
            for (const OrientedEdge& use : loop) {
                const auto [other, first] = normals.emplace(use.edge, normal);
                const double cosine = normal.dot(other->second);
                crease = crease || (!first && cosine > std::sqrt(0.5) && cosine < 1 - 1e-6);
            }
        }
    }
    return crease;
}

}  // namespace detail

PAVIOR_INLINE BlockedModel block_model(const AnyModel& b, SolidId solid, const BlockOptions& options,
                                       const ReferenceMesher& reference) {
    BlockedModel result;
    FeatureOptions features;
    if (detail::has_shallow_crease(b, solid)) {
        features.end_below = 179.9;
        features.corner_above = 180.1;
        features.reversal_above = 315;
        result.shallow_creases = true;
    }
    result.reference = reference(solid, options.refine ? options.refine->size : 0.0, features);
    result.blocks = block_solid(result.reference.mesh, options);
    return result;
}

}  // namespace pavior
