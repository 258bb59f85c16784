#pragma once
/// \file
/// Which methods take a piece of a solid, found by recognition alone.

#include <pavior/core/error.hpp>
#include <pavior/decompose/edge_angles.hpp>
#include <pavior/decompose/piece_methods.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/brep_body.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/revolution.hpp>
#include <pavior/many_to_many/unrolled_brep.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/submap/submap_recognition.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

/// Whether a many-to-many sweep would get as far as a body: no edge between its sides turns back.
template <brep B>
[[nodiscard]] bool makes_body(const B& b, std::span<const SolidId> solids, const Extrusion& extrusion) {
    if (!extrusion.possible() || extrusion.caps == 0) {
        return false;
    }
    double longest = 0;
    for (const FaceId f : faces_of(b, solids)) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                longest = std::max(longest, b.edge_length(use.edge));
            }
        }
    }
    try {
        return !BrepBody<B>(b, solids, extrusion, 0.01 * longest, 0.5 * longest).body().caps.empty();
    } catch (const UnmeshableError&) {
        return false;
    }
}

}  // namespace detail

/// What takes \p solid by itself, submapped with \p turns (SubmapOptions::turns). A few milliseconds, most of them for
/// \p solver. Deterministic if that is.
template <brep B, integer_solver Solver>
[[nodiscard]] PieceMethods recognise_piece(const B& b, SolidId solid, Solver&& solver,
                                           const std::vector<EdgeId>& turns = {}) {
    const std::span<const SolidId> one(&solid, 1);
    PieceMethods result;
    for (const EdgeAngle& angle : edge_angles(b, solid)) {
        result.cusps += angle.least < 15 ? 1 : 0;
    }
    try {
        result.sweep = !recognise_sweeps(b, solid).candidates.empty();
        (void)recognise_submaps(b, one, SubmapOptions{{}, turns}, solver);
        result.submap = true;
    } catch (const UnmeshableError&) {
        result.submap = false;
    }
    if (result.submap || result.sweep) {
        return result;
    }
    const std::vector<Extrusion> extrusions = recognise_extrusions(b, one);
    result.leaning = extrusions.empty() ? b.solid_faces(solid).size() : extrusions.front().refusals.size();
    for (const Extrusion& extrusion : extrusions) {
        if (detail::makes_body(b, one, extrusion)) {
            result.directions.push_back(extrusion.direction);
        }
    }
    result.multi_sweep = !result.directions.empty();
    for (const Axis& axis : result.multi_sweep ? std::vector<Axis>{} : revolution_axes(b, one)) {
        const Unrolling any(axis, axis.direction.unitOrthogonal(), 1);
        if (is_extrusion(UnrolledBrep(b, any), one, Vec3::UnitY(), {1e-3, 89.9})) {
            if (const auto map = unroll_round(b, one, axis, 1)) {
                const UnrolledBrep view(b, *map);
                result.multi_sweep =
                    result.multi_sweep || detail::makes_body(view, one, extrusion_along(view, one, Vec3::UnitY()));
            }
        }
    }
    result.leaning = result.multi_sweep ? 0 : std::max<std::size_t>(result.leaning, 1);
    return result;
}

}  // namespace pavior
