#pragma once
/// \file
/// Which methods take a piece of a solid, found by recognition alone.

#include <pavior/core/error.hpp>
#include <pavior/decompose/edge_angles.hpp>
#include <pavior/decompose/piece_methods.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/revolution.hpp>
#include <pavior/many_to_many/unrolled_brep.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/submap/submap_recognition.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// What takes \p solid by itself. A few milliseconds, most of them for \p solver. Deterministic if that is.
template <brep B, integer_solver Solver>
[[nodiscard]] PieceMethods recognise_piece(const B& b, SolidId solid, Solver&& solver) {
    const std::span<const SolidId> one(&solid, 1);
    PieceMethods result;
    for (const EdgeAngle& angle : edge_angles(b, solid)) {
        result.cusps += angle.least < 15 ? 1 : 0;
    }
    try {
        result.sweep = !recognise_sweeps(b, solid).candidates.empty();
        (void)recognise_submaps(b, one, SubmapOptions{}, solver);
        result.submap = true;
    } catch (const UnmeshableError&) {
        result.submap = false;
    }
    if (result.submap || result.sweep) {
        return result;
    }
    const std::vector<Extrusion> extrusions = recognise_extrusions(b, one);
    result.leaning = extrusions.empty() ? b.solid_faces(solid).size() : extrusions.front().refusals.size();
    // All faces of a ball are sides by the samples on its seam.
    result.multi_sweep = !extrusions.empty() && result.leaning == 0 && extrusions.front().caps > 0;
    if (!result.multi_sweep) {
        for (const Axis& axis : revolution_axes(b, one)) {
            const Unrolling any(axis, axis.direction.unitOrthogonal(), 1);
            result.multi_sweep =
                result.multi_sweep || (is_extrusion(UnrolledBrep(b, any), one, Vec3::UnitY(), {1e-3, 89.9}) &&
                                       unroll_round(b, one, axis, 1).has_value());
        }
    }
    return result;
}

}  // namespace pavior
