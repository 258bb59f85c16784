#pragma once

#include <pavior/part/detail/part_text.hpp>

#include <algorithm>
#include <sstream>
#include <variant>

namespace pavior {

namespace detail {

[[nodiscard]] inline std::string text_of(const Vec3& x) {
    const Vec3 d = x + Vec3::Zero();  // no -0
    std::ostringstream text;
    text << "(" << d[0] << ", " << d[1] << ", " << d[2] << ")";
    return text.str();
}

}  // namespace detail

PAVIOR_INLINE std::string text_of(const SweepPath& path, const std::vector<int>& edges) {
    if (path.axis) {
        return "round the axis through " + detail::text_of(path.axis->origin) + " along " +
               detail::text_of(path.axis->direction);
    }
    std::string text;
    for (const int tag : edges) {
        text += (text.empty() ? "parallel to edges " : ", ") + std::to_string(tag);
    }
    return text.empty() ? "along " + detail::text_of(path.direction) : text;
}

namespace detail {

PAVIOR_INLINE std::string note_of(const SubmapSolidReport& solid) {
    std::ostringstream note;
    note << "box of the lattice " << solid.high[0] - solid.low[0] << " x " << solid.high[1] - solid.low[1] << " x "
         << solid.high[2] - solid.low[2] << ", angles within " << solid.deviation << " degrees of their class";
    return note.str();
}

PAVIOR_INLINE std::string note_of(const MultiSweepAttempt& attempt, const std::vector<int>& edges) {
    std::ostringstream text;
    text << pavior::text_of(attempt.path, edges) << ", merging within " << attempt.merge << " sizes, chords within "
         << attempt.chord << ": " << (attempt.error.empty() ? "least scaled Jacobian " : attempt.error);
    if (attempt.error.empty()) {
        text << attempt.quality << ", boundary nodes within " << attempt.face_distance << " of their faces";
    }
    return text.str();
}

struct SurfaceText {
    std::string operator()(const CutPlane& s) const {
        return "plane through " + text_of(s.point) + " normal to " + text_of(s.normal);
    }
    std::string operator()(const CutHalfPlane& s) const {
        return "half-plane from the line through " + text_of(s.point) + " along " + text_of(s.along) + " towards " +
               text_of(s.into);
    }
    std::string operator()(const CutCylinder& s) const {
        std::ostringstream radius;
        radius << s.radius;
        return "cylinder of radius " + radius.str() + " round the axis through " + text_of(s.point) + " along " +
               text_of(s.direction);
    }
};

PAVIOR_INLINE std::string text_of(const CutSurface& surface) { return std::visit(SurfaceText{}, surface); }

PAVIOR_INLINE std::string text_of(const SolidCut& cut) {
    std::string text(to_string(cut.reason));
    for (std::size_t i = 0; i < cut.surfaces.size(); ++i) {
        text += (i == 0 ? ": " : ", ") + text_of(cut.surfaces[i]);
    }
    if (!cut.curves.empty()) {
        text += (cut.surfaces.empty() ? ": " : ", ") + std::to_string(cut.curves.size()) + " lines along them";
    }
    return text;
}

PAVIOR_INLINE UnmeshableError not_decomposed(const CutSearch& search) {
    std::ostringstream text;
    text << "no cuts were found after which all pieces can be meshed together: " << search.tried << " were tried, "
         << search.meshed << " times all pieces were of a kind that a method takes";
    return {ErrorCode::not_sweepable, text.str()};
}

PAVIOR_INLINE void require_blocks(const SolidBlocks& blocks) {
    if (blocks.report.dual.valid()) {
        return;
    }
    const auto& violations = blocks.report.dual.violations;
    std::ostringstream text;
    text << "the layers make no blocks, " << violations.size() << " conditions are violated";
    if (!violations.empty()) {
        text << ", the first: " << describe(violations.front());
    }
    throw UnmeshableError(ErrorCode::invalid_dual, text.str());
}

PAVIOR_INLINE void refuse(MethodTry& result, const Error& error) {
    result.outcome = TryOutcome::refused;
    result.reason = error.what();
    const ErrorCode code = error.code();
    if (code == ErrorCode::not_sweepable || code == ErrorCode::not_submappable || code == ErrorCode::cad_failure) {
        result.faces.assign(error.ids().begin(), error.ids().end());
        std::sort(result.faces.begin(), result.faces.end());
        result.faces.erase(std::unique(result.faces.begin(), result.faces.end()), result.faces.end());
    }
}

}  // namespace detail

}  // namespace pavior
