#pragma once

#include <pavior/decompose/best_cuts.hpp>
#include <pavior/part/decompose_solids.hpp>
#include <pavior/part/detail/hex_jacobian.hpp>
#include <pavior/part/entity_groups.hpp>

#include <algorithm>
#include <utility>

namespace pavior {

namespace detail {

/// The solid of the worst hexahedron.
[[nodiscard]] inline SolidId worst_solid(const MethodTry& mesh) {
    SolidId worst;
    double least = 2;
    for (std::size_t h = 0; h < mesh.data.mesh.hexes.size(); ++h) {
        const double own = scaled_jacobian(mesh.data.mesh, h);
        if (own < least) {
            least = own;
            worst = mesh.hex_solid[h];
        }
    }
    return worst;
}

/// Tells a mesh of pieces of the solids and faces that they are pieces of.
inline void tell_of_whole(const AnyModel& model, std::span<const SolidId> solids, const ModelPieces& pieces,
                          std::span<const FaceId> faces, MethodTry& mesh) {
    for (SolidId& solid : mesh.hex_solid) {
        solid = pieces.solid[solid.index()];
    }
    std::size_t kept = 0;
    for (std::size_t q = 0; q < mesh.data.quads.size(); ++q) {
        const FaceId face = faces[mesh.quad_face[q].index()];
        if (face.valid()) {
            mesh.data.quads[kept] = mesh.data.quads[q];
            mesh.data.quad_groups[kept] = mesh.data.quad_groups[q];
            mesh.quad_face[kept++] = face;
        }
    }
    mesh.data.quads.resize(kept);
    mesh.data.quad_groups.resize(kept);
    mesh.quad_face.resize(kept);
    mesh.data.groups = entity_groups(model, solids);
}

}  // namespace detail

PAVIOR_INLINE DecomposedSolids decompose_solids(const AnyModel& model, std::span<const SolidId> solids,
                                                const SolidCutter& cut, const IntegerSolver& solver,
                                                const PieceMesher& mesh, const std::function<bool()>& out_of_time,
                                                const CutSearchOptions& options) {
    DecomposedSolids result;
    const auto verdict = [&](const ModelPieces& pieces, std::span<const SolidId> parts,
                             std::span<const PieceMethods> methods) {
        const auto all = [&](bool PieceMethods::*method) {
            return std::all_of(methods.begin(), methods.end(), [&](const PieceMethods& m) { return m.*method; });
        };
        const std::vector<FaceId> faces = pieces.identify();
        PiecesVerdict found;
        const auto attempt = [&](PartMethod method) {
            if (found.quality >= options.sufficient || out_of_time()) {
                return;
            }
            MethodTry next = mesh(method, pieces, parts);
            if (next.outcome != TryOutcome::mesh || next.min_jacobian <= found.quality) {
                return;
            }
            found.quality = next.min_jacobian;
            found.guilty = detail::worst_solid(next);
            if (result.mesh.outcome != TryOutcome::mesh || next.min_jacobian > result.mesh.min_jacobian) {
                detail::tell_of_whole(model, solids, pieces, faces, next);
                result.mesh = std::move(next);
                result.methods.assign(methods.begin(), methods.end());
            }
        };
        if (all(&PieceMethods::submap)) {
            attempt(PartMethod::submap);
        }
        if (all(&PieceMethods::sweep)) {
            attempt(PartMethod::sweep);
        }
        attempt(PartMethod::mixed);
        return found;
    };
    const auto piece_quality = [&](const ModelPieces& pieces, SolidId piece, const PieceMethods& methods) {
        double best = -1;
        const std::span<const SolidId> one(&piece, 1);
        for (const auto& [takes, method] : {std::pair(methods.submap, PartMethod::submap),
                                            {methods.sweep, PartMethod::sweep},
                                            {methods.multi_sweep, PartMethod::multi_sweep}}) {
            if (takes && best < options.sufficient && !out_of_time()) {
                const MethodTry alone = mesh(method, pieces, one);
                best = alone.outcome == TryOutcome::mesh ? std::max(best, alone.min_jacobian) : best;
            }
        }
        return best;
    };
    result.search = best_cuts<ModelPieces>(solids, cut, solver, verdict, out_of_time, options, piece_quality);
    return result;
}

}  // namespace pavior
