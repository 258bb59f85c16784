#pragma once
/// \file
/// Recognition of one-to-one sweepable solids \cite roca2009 (section 2.1, conditions (i) to (iv)).

#include <pavior/brep/seamless.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/cap_plane.hpp>
#include <pavior/one_to_one/side_stacking.hpp>
#include <pavior/one_to_one/sweep_conditions.hpp>
#include <pavior/one_to_one/sweep_shape.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct RecognitionOptions {
    bool stacked = true;           ///< also look for linking sides that lie above each other along the sweep
    StackingOptions stacking;      ///< used if `stacked`
    double max_deviation = 85.0;   ///< corners of linking sides, and their angles to the caps, are 90 +- this, degrees
    std::size_t max_refusals = 3;  ///< how many pairs of an unsweepable solid are explained
};

/// All ways to sweep a solid, best first (`better_sweep`), or the reasons why there is none.
struct Recognition {
    SolidId solid;
    std::vector<SweepTopology> candidates;  ///< unordered pairs: the source is the face with the lower id
    std::vector<SweepRefusal> refusals;     ///< only if there is no candidate: the pairs that come closest, best first

    [[nodiscard]] bool sweepable() const { return !candidates.empty(); }
};

namespace detail {

/// A pair of caps: the sweep between them, or what is wrong with the shape of the sweep that topology allows, or
/// neither.
struct PairOutcome {
    std::optional<SweepTopology> sweep;
    std::vector<SweepObstacle> obstacles;
};

/// Judges two faces of a solid (positions).
template <brep B>
[[nodiscard]] PairOutcome judge_pair(const B& b, const SolidBoundary& solid, const RolePatterns& patterns,
                                     std::size_t source, std::size_t target, const RecognitionOptions& options,
                                     std::size_t& tests_left) {
    PairOutcome result;
    if (caps_fit(solid, source, target)) {
        result.sweep = find_direct_sweep(solid, source, target);
        if (!result.sweep && options.stacked) {
            result.sweep = find_stacked_sweep(solid, patterns, source, target, tests_left);
        }
    }
    if (result.sweep) {
        result.sweep->shape = sweep_shape(b, *result.sweep);
        result.obstacles = shape_obstacles(b, *result.sweep, options.max_deviation);
        if (!result.obstacles.empty()) {
            result.sweep.reset();
        }
    }
    return result;
}

/// judge_pair() where one or both are caps with a seam: of the boundary without the seams of these.
template <brep B>
[[nodiscard]] PairOutcome judge_seamed_pair(const B& b, const SolidBoundary& solid, std::size_t source,
                                            std::size_t target, const RecognitionOptions& options,
                                            std::size_t& tests_left) {
    const SolidBoundary seamless = without_seams(solid, std::array{source, target});
    if (!caps_fit(seamless, source, target)) {
        return {};
    }
    return judge_pair(b, seamless, RolePatterns(seamless, options.stacking), source, target, options, tests_left);
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

/// Whether the face at a position is a cap if its seam is left out.
template <brep B>
[[nodiscard]] bool seamed_cap(const B& b, const SolidBoundary& solid, std::size_t face) {
    return solid.faces[face].seam && cap_plane(b, solid.faces[face].face.face);
}

/// The sweeps with a cap that has a seam.
template <brep B>
[[nodiscard]] std::vector<SweepTopology> seamed_sweeps(const B& b, const SolidBoundary& solid,
                                                       const RecognitionOptions& options, std::size_t& tests_left) {
    std::vector<SweepTopology> result;
    std::vector<char> seamed;
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        seamed.push_back(static_cast<char>(seamed_cap(b, solid, i)));
    }
    const auto usable = [&](std::size_t i) { return seamed[i] != 0 || !solid.faces[i].seam; };
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        for (std::size_t j = i + 1; j < solid.faces.size(); ++j) {
            if ((seamed[i] == 0 && seamed[j] == 0) || !usable(i) || !usable(j)) {
                continue;
            }
            const bool ordered = solid.faces[i].face.face < solid.faces[j].face.face;
            PairOutcome outcome = judge_seamed_pair(b, solid, ordered ? i : j, ordered ? j : i, options, tests_left);
            if (outcome.sweep) {
                result.push_back(std::move(*outcome.sweep));
            }
        }
    }
    return result;
}

/// Adds the pairs that break the fewest conditions, explained, until there are \p count.
PAVIOR_INLINE void add_closest_refusals(const SolidBoundary& solid, std::size_t count,
                                        std::vector<SweepRefusal>& refusals);

}  // namespace detail

/// Finds every pair of faces of \p solid between which it is a one-to-one sweep, and ranks the pairs.
///
/// Conditions: the caps have equally many loops and touch nowhere, and one with a seam (a dome round its pole) leans by
/// less than 80 degrees (cap_plane()) and counts only if there are no caps without; every other face is a linking side
/// (one loop, four logical sides or a union of such rectangles); the linking sides form, round each loop of the source,
/// a ring that ends at exactly one loop of the target. Side faces that reach from cap to cap are judged by topology
/// alone, side faces above each other also by their corner angles (StackingOptions). Corners of linking sides and
/// angles between them and the caps near 0, near 180 (a fillet at the rim of a cap) or beyond are refused, since the
/// hexahedra there cannot be valid (max_deviation). Geometry is not checked further.
/// Sides above each other are searched for within a bounded amount of work (StackingOptions::max_tests), so that a
/// sweep may be missed on solids with hundreds of faces whose corners are ambiguous; direct sweeps are never missed.
/// Deterministic. O(f^2) face pairs, each O(n) for n edges, most of them rejected early.
/// \throws InputError non_manifold if the faces do not close the solid.
template <brep B>
[[nodiscard]] Recognition recognise_sweeps(const B& b, SolidId solid, const RecognitionOptions& options = {}) {
    const SolidBoundary boundary = solid_boundary(b, solid);
    Recognition result;
    result.solid = solid;
    const detail::RolePatterns patterns(boundary, options.stacking);
    std::size_t tests_left = options.stacking.max_tests;
    std::vector<SweepRefusal> misshapen;
    for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
        for (std::size_t j = i + 1; j < boundary.faces.size(); ++j) {
            const bool ordered = boundary.faces[i].face.face < boundary.faces[j].face.face;
            const std::size_t source = ordered ? i : j, target = ordered ? j : i;
            detail::PairOutcome outcome =
                detail::judge_pair(b, boundary, patterns, source, target, options, tests_left);
            if (outcome.sweep) {
                result.candidates.push_back(std::move(*outcome.sweep));
            } else if (!outcome.obstacles.empty()) {
                misshapen.push_back(make_refusal(boundary, source, target, std::move(outcome.obstacles)));
            }
        }
    }
    if (result.candidates.empty()) {
        result.candidates = detail::seamed_sweeps(b, boundary, options, tests_left);
    }
    std::stable_sort(result.candidates.begin(), result.candidates.end(), better_sweep);
    if (result.candidates.empty()) {
        result.refusals = std::move(misshapen);
        result.refusals.resize(std::min(result.refusals.size(), options.max_refusals));
        detail::add_closest_refusals(boundary, options.max_refusals, result.refusals);
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
    const detail::RolePatterns patterns(boundary, options.stacking);
    std::size_t tests_left = options.stacking.max_tests;
    detail::PairOutcome outcome = detail::judge_pair(b, boundary, patterns, s, t, options, tests_left);
    if (!outcome.sweep && outcome.obstacles.empty() && (boundary.faces[s].seam || boundary.faces[t].seam) &&
        (!boundary.faces[s].seam || detail::seamed_cap(b, boundary, s)) &&
        (!boundary.faces[t].seam || detail::seamed_cap(b, boundary, t))) {
        outcome = detail::judge_seamed_pair(b, boundary, s, t, options, tests_left);
    }
    if (!outcome.sweep) {
        throw detail::not_sweepable_error(
            boundary, {outcome.obstacles.empty() ? explain_refusal(boundary, s, t)
                                                 : make_refusal(boundary, s, t, std::move(outcome.obstacles))});
    }
    return std::move(*outcome.sweep);
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

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/recognition-inl.hpp>
#endif
