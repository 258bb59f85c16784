#pragma once

#include <pavior/brep/boundary_deviation.hpp>
#include <pavior/part/cad_deviation.hpp>
#include <pavior/part/judge_mesh.hpp>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace pavior {

namespace detail {

[[nodiscard]] inline double boundary_area(const HexMeshData& data) {
    double area = 0;
    for (const QuadCorners& quad : data.quads) {
        const auto& x = data.mesh.nodes;
        area += quad_area({x[quad[0]], x[quad[1]], x[quad[2]], x[quad[3]]});
    }
    return area;
}

/// "solids 1, 2: ", or nothing.
[[nodiscard]] inline std::string name_of_solids(const AnyModel& b, std::span<const SolidId> solids) {
    std::string text = solids.size() == 1 ? "solid " : "solids ";
    for (std::size_t i = 0; i < solids.size(); ++i) {
        text.append(i == 0 ? "" : ", ").append(std::to_string(b.tag(3, solids[i].index())));
    }
    return text + ": ";
}

/// Whether the volumes agree to 1e-6 and the slack, or differ by no more than lies between the quads and the curved faces; nothing
/// where that is not known.
[[nodiscard]] inline std::optional<bool> same_volume(const CadDeviation& deviation, bool has_quads, double slack) {
    if (!deviation.cad_volume) {
        return std::nullopt;
    }
    const double error = std::abs(deviation.volume - *deviation.cad_volume) - 1e-6 * *deviation.cad_volume - slack;
    if (error <= 0) {
        return true;
    }
    return deviation.distance || !has_quads ? std::optional(deviation.between >= error) : std::nullopt;
}

}  // namespace detail

PAVIOR_INLINE MeshCheck judge_mesh(const AnyModel& b, std::span<const SolidId> solids, const JudgeOptions& options,
                                   MethodTry& result) {
    const MeshCheck check = check_mesh(result.data.mesh, options.execution);
    const CadDeviation measured = result.deviation;
    if (check.verify.ok()) {
        result.deviation = cad_deviation(b, solids, result.data.mesh.nodes, result.data.quads, result.quad_face,
                                         check.verify.volume, options.size, options.out_of_time);
    }
    const bool has_quads = !result.data.quads.empty();
    const std::optional<bool> complete =
        detail::same_volume(result.deviation, has_quads,
                            options.tolerance > 0 ? options.tolerance * detail::boundary_area(result.data) : 0);
    const bool checked = result.deviation.distance.has_value() || !has_quads;
    if (measured.distance) {
        result.deviation.distance = measured.distance;
    }
    result.hexahedra = check.hexahedra;
    result.min_jacobian = check.quality.scaled_jacobian.min;
    const bool flat = !(result.min_jacobian > 1e-6);
    result.outcome = check.valid() && complete.value_or(true) && !flat ? TryOutcome::mesh : TryOutcome::invalid;
    std::ostringstream reason;
    if (!check.verify.ok()) {
        reason << check.verify.text();
    } else if (check.quality.inverted > 0) {
        reason << check.quality.inverted << " inverted hexahedra";
    } else if (flat) {
        reason << "hexahedra are flat, the least scaled Jacobian is " << result.min_jacobian;
    } else if (!complete.value_or(true)) {
        reason << "its volume is " << check.verify.volume << ", that of the CAD model " << *result.deviation.cad_volume;
    } else {
        if (!checked) {
            result.warnings.emplace_back("the distance from the CAD was not checked: out of time");
        }
        for (const std::string& warning : warnings_of(result.deviation)) {
            result.warnings.push_back(options.alone ? warning : detail::name_of_solids(b, solids) + warning);
        }
    }
    result.reason = reason.str();
    return check;
}

}  // namespace pavior
