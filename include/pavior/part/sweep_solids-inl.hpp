#pragma once

#include <pavior/core/error.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>
#include <pavior/part/detail/finer_sizes.hpp>
#include <pavior/part/sweep_solids.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>

namespace pavior {

namespace detail {

[[nodiscard]] inline std::optional<FaceId> face_with_tag(const AnyModel& b, std::optional<int> tag, const char* what) {
    if (!tag) {
        return std::nullopt;
    }
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        if (has_tag(b, 2, f, *tag)) {
            return FaceId{static_cast<std::int32_t>(f)};
        }
    }
    throw InputError(ErrorCode::bad_option,
                     std::string(what) + " " + std::to_string(*tag) + ": the model has no such face", {*tag});
}

[[nodiscard]] inline bool bounds(const AnyModel& b, SolidId solid, std::optional<FaceId> face) {
    const std::span<const OrientedFace> faces = b.solid_faces(solid);
    return face && std::any_of(faces.begin(), faces.end(), [&](const OrientedFace& f) { return f.face == *face; });
}

/// The best sweep of a solid with the given caps as far as they bound it.
[[nodiscard]] inline SweepTopology sweep_with_caps(const AnyModel& b, SolidId solid, std::optional<FaceId> source,
                                                   std::optional<FaceId> target) {
    const bool with_source = bounds(b, solid, source);
    const bool with_target = bounds(b, solid, target);
    if (with_source && with_target) {
        return sweep_between(b, solid, *source, *target);
    }
    if (!with_source && !with_target) {
        return best_sweep(b, solid);
    }
    const FaceId wanted = with_source ? *source : *target;
    for (const SweepTopology& sweep : recognise_sweeps(b, solid).candidates) {
        if (sweep.source == wanted || sweep.target == wanted) {
            return (sweep.source == wanted) == with_source ? sweep : reversed(sweep);
        }
    }
    const int tag = b.tag(2, wanted.index());
    throw UnmeshableError(ErrorCode::not_sweepable,
                          "solid " + std::to_string(b.tag(3, solid.index())) + " has no sweep with face " +
                              std::to_string(tag) + " as a cap",
                          {tag});
}

inline void add_sweep_warnings(const AnyModel& b, double max_angle, SweptSolids& result) {
    if (!result.intervals.angles_kept) {
        std::ostringstream text;
        text << "the numbers prescribed leave curved edges coarser than " << max_angle << " degrees an interval";
        result.warnings.push_back(text.str());
    }
    for (const LinkingFaceReport& side : result.mesh.sides) {
        if (!side.folded.empty()) {
            result.warnings.push_back("face " + std::to_string(b.tag(2, side.face.index())) + ": " +
                                      std::to_string(side.folded.size()) + " folded quads");
        }
    }
    for (const SolidReport& solid : result.mesh.solids) {
        if (solid.target_projection && !solid.target_projection->folded.empty()) {
            result.warnings.push_back("face " + std::to_string(b.tag(2, solid.target.index())) + ": " +
                                      std::to_string(solid.target_projection->folded.size()) +
                                      " folded quads on the target");
        }
    }
}

}  // namespace detail

PAVIOR_INLINE SweptSolids sweep_solids(const AnyModel& b, std::span<const SolidId> solids,
                                       const SweepSolidsOptions& options, const IntegerSolver& solver,
                                       const CapMesher& mesher) {
    report(options.sweep.progress, "recognition", 0);
    const std::optional<FaceId> source = detail::face_with_tag(b, options.source, "source");
    const std::optional<FaceId> target = detail::face_with_tag(b, options.target, "target");
    std::vector<SweepTopology> sweeps;
    for (const SolidId solid : solids) {
        sweeps.push_back(detail::sweep_with_caps(b, solid, source, target));
    }
    SweptSolids result;
    IntervalOptions wishes = options.intervals;
    detail::with_finer_sizes(wishes.size, result.warnings, [&](double size, int min_loop) {
        wishes.size = size;
        wishes.min_loop = min_loop;
        report(options.sweep.progress, "intervals", 0);
        result.intervals = assign_intervals(b, sweeps, wishes, solver);
        result.mesh = sweep_model(b, sweeps, result.intervals.intervals, mesher, options.sweep);
    });
    detail::add_sweep_warnings(b, wishes.max_angle, result);
    return result;
}

}  // namespace pavior
