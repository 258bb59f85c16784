#pragma once

#include <pavior/brep/boundary_deviation.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/part/cad_deviation.hpp>
#include <pavior/part/model_extras.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <utility>

namespace pavior {

namespace detail {

/// "12.3 %", or "0.0123 %" where it is little.
[[nodiscard]] inline std::string percent(double part) {
    std::ostringstream text;
    text.precision(3);
    text << 100 * part << " %";
    return text.str();
}

/// Largest distance of the corners of quads on plane faces; the others go to \p curved.
[[nodiscard]] inline double plane_distance(const AnyModel& b, std::span<const Vec3> nodes,
                                           std::span<const QuadCorners> quads, std::span<const FaceId> faces,
                                           std::vector<QuadCorners>& curved, std::vector<FaceId>& curved_faces) {
    std::vector<std::optional<FacePlane>> planes(b.face_count());
    std::vector<char> asked(b.face_count(), 0);
    double farthest = 0;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        std::optional<FacePlane>& plane = planes[faces[q].index()];
        if (std::exchange(asked[faces[q].index()], 1) == 0) {
            plane = plane_of(b, faces[q]);
        }
        if (plane) {
            for (const Index i : quads[q]) {
                farthest = std::max(farthest, std::abs(plane->normal.dot(nodes[i] - plane->point)));
            }
        } else {
            curved.push_back(quads[q]);
            curved_faces.push_back(faces[q]);
        }
    }
    return farthest;
}

}  // namespace detail

PAVIOR_INLINE CadDeviation cad_deviation(const AnyModel& b, std::span<const SolidId> solids,
                                         std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                         std::span<const FaceId> faces, double volume, double size,
                                         const std::function<bool()>& out_of_time) {
    CadDeviation result;
    result.volume = volume;
    result.size = size;
    result.cad_volume = 0.0;
    for (const SolidId solid : solids) {
        const std::optional<double> own = volume_of(b, solid);
        result.cad_volume = result.cad_volume && own ? std::optional(*result.cad_volume + *own) : std::nullopt;
    }
    if (quads.empty() || faces.size() != quads.size()) {
        return result;
    }
    std::vector<QuadCorners> curved_quads;
    std::vector<FaceId> curved_faces;
    const double on_planes = detail::plane_distance(b, nodes, quads, faces, curved_quads, curved_faces);
    const auto go_on = [&](const BoundaryDeviation& so_far) {
        return so_far.quads % 64 != 0 || !out_of_time || !out_of_time();
    };
    const BoundaryDeviation curved = boundary_deviation(b, nodes, curved_quads, curved_faces, go_on);
    if (curved.quads == curved_quads.size()) {
        result.distance = std::max(on_planes, curved.distance);
        result.between = curved.volume;
    }
    return result;
}

PAVIOR_INLINE CadDeviation operator+(const CadDeviation& a, const CadDeviation& b) {
    CadDeviation sum;
    sum.volume = a.volume + b.volume;
    sum.size = std::max(a.size, b.size);
    sum.between = a.between + b.between;
    if (a.cad_volume && b.cad_volume) {
        sum.cad_volume = *a.cad_volume + *b.cad_volume;
    }
    if (a.distance && b.distance) {
        sum.distance = std::max(*a.distance, *b.distance);
    }
    return sum;
}

PAVIOR_INLINE std::vector<std::string> warnings_of(const CadDeviation& deviation) {
    std::vector<std::string> warnings;
    if (const auto part = deviation.relative_volume(); part && std::abs(*part) > noteworthy_volume) {
        warnings.push_back("the mesh has " + detail::percent(std::abs(*part)) + (*part < 0 ? " less" : " more") +
                           " volume than the geometry; " +
                           (deviation.size > 0 ? "a smaller size" : "a fine mesh inside the blocks") +
                           " follows it more closely");
    }
    if (const auto sizes = deviation.distance_in_sizes(); sizes && *sizes > noteworthy_distance) {
        std::ostringstream text;
        text.precision(3);
        text << "the boundary of the mesh is up to " << *deviation.distance << " away from the geometry, " << *sizes
             << " of the size";
        warnings.push_back(text.str());
    }
    return warnings;
}

PAVIOR_INLINE bool lacks_a_part(const CadDeviation& deviation, double max_angle) {
    const double angle = max_angle * std::numbers::pi / 180;
    const double most = std::max(noteworthy_volume, 2.5 * (1 - std::sin(angle) / angle));
    return std::abs(deviation.relative_volume().value_or(0.0)) > most;
}

PAVIOR_INLINE std::string text_of(const CadDeviation& deviation) {
    std::ostringstream text;
    text.precision(3);
    if (const auto part = deviation.relative_volume()) {
        const double shown = std::abs(*part) < 1e-12 ? 0.0 : 100 * *part;
        text << "volume " << (shown > 0 ? "+" : "") << shown << " % off the geometry";
    }
    if (deviation.distance) {
        const auto sizes = deviation.distance_in_sizes();
        const double shown = sizes.value_or(*deviation.distance);
        text << (text.str().empty() ? "" : ", ") << "boundary within " << (shown < 1e-12 ? 0.0 : shown)
             << (sizes ? " sizes of it" : " of it");
    }
    return text.str();
}

}  // namespace pavior
