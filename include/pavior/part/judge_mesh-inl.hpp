#pragma once

#include <pavior/brep/chord_volume.hpp>
#include <pavior/part/judge_mesh.hpp>
#include <pavior/part/model_extras.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <vector>

namespace pavior {

namespace detail {

/// True if the volumes agree to 1e-6, or differ by no more than lies between the quads and the curved faces.
[[nodiscard]] inline bool same_volume(const AnyModel& b, const HexMeshData& data, double volume, double solid_volume) {
    const double error = std::abs(volume - solid_volume) - 1e-6 * solid_volume;
    if (error <= 0) {
        return true;
    }
    std::map<int, FaceId> curved = faces_by_tag(b);
    std::erase_if(curved, [&](const auto& entry) { return is_plane(b, entry.second); });
    std::vector<QuadCorners> quads;
    std::vector<FaceId> faces;
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (const auto found = curved.find(data.quad_groups[q]); found != curved.end()) {
            quads.push_back(data.quads[q]);
            faces.push_back(found->second);
        }
    }
    return chord_volume(b, data.mesh.nodes, quads, faces, error) >= error;
}

}  // namespace detail

PAVIOR_INLINE std::pair<MeshCheck, std::optional<double>> judge_mesh(const AnyModel& b, std::span<const SolidId> solids,
                                                                     Execution execution, MethodTry& result) {
    const MeshCheck check = check_mesh(result.data.mesh, execution);
    std::optional<double> volume = 0.0;
    for (const SolidId solid : solids) {
        const std::optional<double> own = volume_of(b, solid);
        volume = volume && own ? std::optional(*volume + *own) : std::nullopt;
    }
    const bool complete = !volume || detail::same_volume(b, result.data, check.verify.volume, *volume);
    result.hexahedra = check.hexahedra;
    result.min_jacobian = check.quality.scaled_jacobian.min;
    const bool flat = !(result.min_jacobian > 1e-6);
    result.outcome = check.valid() && complete && !flat ? TryOutcome::mesh : TryOutcome::invalid;
    std::ostringstream reason;
    if (!check.verify.ok()) {
        reason << check.verify.text();
    } else if (check.quality.inverted > 0) {
        reason << check.quality.inverted << " inverted hexahedra";
    } else if (flat) {
        reason << "hexahedra are flat, the least scaled Jacobian is " << result.min_jacobian;
    } else if (!complete) {
        reason << "its volume is " << check.verify.volume << ", that of the CAD model " << *volume;
    }
    result.reason = reason.str();
    return {check, volume};
}

}  // namespace pavior
