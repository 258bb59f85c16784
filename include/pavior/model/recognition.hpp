#pragma once
/// \file
/// Recognition of one-to-one sweepable solids \cite roca2009 (section 2.1, conditions (i) to (iv)).

#include <pavior/model/side_stacking.hpp>
#include <pavior/model/sweep_conditions.hpp>
#include <pavior/model/sweep_shape.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct RecognitionOptions {
    bool stacked = true;          ///< also look for linking sides that lie above each other along the sweep
    StackingOptions stacking;     ///< used if `stacked`
    std::size_t max_refusals = 3; ///< how many pairs of an unsweepable solid are explained
};

/// All ways to sweep a solid, best first (`better_sweep`), or the reasons why there is none.
struct Recognition {
    SolidId solid;
    std::vector<SweepTopology> candidates;  ///< unordered pairs: the source is the face with the lower id
    std::vector<SweepRefusal> refusals;     ///< only if there is no candidate: the pairs that come closest, best first

    [[nodiscard]] bool sweepable() const { return !candidates.empty(); }
};

namespace detail {

/// The sweep between two faces of a solid (positions), or nothing.
template <brep B>
[[nodiscard]] std::optional<SweepTopology> find_sweep(const B& b, const SolidBoundary& solid, std::size_t source,
                                                      std::size_t target, const RecognitionOptions& options) {
    std::optional<SweepTopology> sweep;
    if (caps_fit(solid, source, target)) {
        sweep = sweep_from_roles(solid, source, target, direct_roles(solid, source, target));
        if (!sweep && options.stacked) {
            sweep = find_stacked_sweep(solid, source, target, options.stacking);
        }
    }
    if (sweep) {
        sweep->shape = sweep_shape(b, *sweep);
    }
    return sweep;
}

/// The position of face \p f in the solid. \throws InputError bad_option
template <brep B>
[[nodiscard]] std::size_t face_position(const B& b, const SolidBoundary& solid, FaceId f) {
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        if (solid.faces[i].face.face == f) {
            return i;
        }
    }
    const std::string name = f.valid() && f.index() < b.face_count() ? std::to_string(b.tag(2, f.index())) : "?";
    throw InputError(ErrorCode::bad_option, "face " + name + " is not a face of solid " + std::to_string(solid.tag),
                     {f.value});
}

/// The pairs that break the fewest conditions, explained.
[[nodiscard]] inline std::vector<SweepRefusal> closest_refusals(const SolidBoundary& solid, std::size_t count) {
    std::vector<SweepRefusal> result;
    if (solid.faces.size() < 3) {
        result.push_back(too_few_faces(solid));
        return result;
    }
    for (const auto& [source, target] : closest_pairs(solid, count)) {
        result.push_back(explain_refusal(solid, source, target));
    }
    return result;
}

}  // namespace detail

/// Finds every pair of faces of \p solid between which it is a one-to-one sweep, and ranks the pairs.
///
/// Conditions: the caps have equally many loops, no seam, and touch nowhere; every other face is a linking side (one
/// loop, four logical sides); the linking sides form, round each loop of the source, a ring that ends at exactly one
/// loop of the target. Side faces that reach from cap to cap are judged by topology alone, side faces above each other
/// also by their corner angles (StackingOptions). Geometry is not checked further: a sweep found here may still be too
/// distorted to give valid hexahedra.
/// Deterministic. O(f^2) face pairs, each O(n) for n edges, most of them rejected early.
/// \throws InputError non_manifold if the faces do not close the solid.
template <brep B>
[[nodiscard]] Recognition recognise_sweeps(const B& b, SolidId solid, const RecognitionOptions& options = {}) {
    const SolidBoundary boundary = solid_boundary(b, solid);
    Recognition result;
    result.solid = solid;
    for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
        for (std::size_t j = i + 1; j < boundary.faces.size(); ++j) {
            const bool ordered = boundary.faces[i].face.face < boundary.faces[j].face.face;
            if (auto sweep = detail::find_sweep(b, boundary, ordered ? i : j, ordered ? j : i, options)) {
                result.candidates.push_back(std::move(*sweep));
            }
        }
    }
    std::stable_sort(result.candidates.begin(), result.candidates.end(), better_sweep);
    if (result.candidates.empty()) {
        result.refusals = detail::closest_refusals(boundary, options.max_refusals);
    }
    return result;
}

/// The sweep of \p solid from \p source to \p target. \throws UnmeshableError not_sweepable with the reason and the
/// user's tags of the faces concerned; InputError bad_option if one is not a face of the solid or both are the same.
template <brep B>
[[nodiscard]] SweepTopology sweep_between(const B& b, SolidId solid, FaceId source, FaceId target,
                                          const RecognitionOptions& options = {}) {
    const SolidBoundary boundary = solid_boundary(b, solid);
    const std::size_t s = detail::face_position(b, boundary, source);
    const std::size_t t = detail::face_position(b, boundary, target);
    if (s == t) {
        throw InputError(ErrorCode::bad_option, "source and target are the same face", {boundary.faces[s].tag});
    }
    if (auto sweep = detail::find_sweep(b, boundary, s, t, options)) {
        return std::move(*sweep);
    }
    throw detail::not_sweepable_error(boundary, {explain_refusal(boundary, s, t)});
}

/// The best candidate. \throws UnmeshableError not_sweepable with the reasons and the user's tags of the faces
/// concerned if there is none.
template <brep B>
[[nodiscard]] SweepTopology best_sweep(const B& b, SolidId solid, const RecognitionOptions& options = {}) {
    Recognition recognition = recognise_sweeps(b, solid, options);
    if (recognition.candidates.empty()) {
        throw detail::not_sweepable_error(solid_boundary(b, solid), recognition.refusals);
    }
    return std::move(recognition.candidates.front());
}

}  // namespace pavior
