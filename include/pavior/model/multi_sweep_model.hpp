#pragma once
/// \file
/// Many-to-many sweep of the solids of a CAD model.

#include <pavior/mesh/quality.hpp>
#include <pavior/model/brep_body.hpp>
#include <pavior/model/extrusion.hpp>
#include <pavior/model/face_distance.hpp>
#include <pavior/model/multi_sweep.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Hexahedra of a model with their entities.
struct MultiSweptModel {
    HexMesh mesh;
    std::vector<SolidId> hex_solid;  ///< one a hexahedron
    std::vector<QuadCorners> quads;  ///< mesh of the faces, about the face's own normal
    std::vector<FaceId> quad_face;   ///< one a quad
    Vec3 direction = Vec3::UnitZ();
    MultiSweepReport report;
};

/// Meshes \p solids of \p b, one conforming mesh for all, along the direction of \p extrusion. Callables as for
/// multi_sweep().
/// \throws UnmeshableError not_sweepable naming faces; what multi_sweep() throws
template <brep B, plane_imprinter I, class Solver, region_mesher M>
[[nodiscard]] MultiSweptModel multi_sweep_model(const B& b, std::span<const SolidId> solids, const Extrusion& extrusion,
                                                const MultiSweepOptions& options, I&& imprint, Solver&& solver,
                                                M&& mesher, const LocalSizes& sizes = {}) {
    const BrepBody<B> body(b, solids, extrusion, options.chord * options.size,
                           std::max(options.merge, 0.1) * options.size, sizes);
    if (body.body().caps.empty()) {
        throw UnmeshableError(ErrorCode::not_sweepable, "no face is a cap");
    }
    MultiSweepMesh swept = multi_sweep(body.body(), body, options, imprint, solver, mesher);
    MultiSweptModel result;
    result.mesh = std::move(swept.mesh);
    result.quads = std::move(swept.quads);
    result.direction = extrusion.direction;
    result.report = std::move(swept.report);
    for (const Index s : swept.hex_solid) {
        result.hex_solid.push_back(solids[s]);
    }
    std::vector<std::vector<char>> outward(solids.size(), std::vector<char>(b.face_count(), 0));
    for (std::size_t s = 0; s < solids.size(); ++s) {
        for (const OrientedFace& f : b.solid_faces(solids[s])) {
            outward[s][f.face.index()] = static_cast<char>(f.outward);
        }
    }
    const std::size_t caps = body.body().caps.size();
    for (std::size_t q = 0; q < result.quads.size(); ++q) {
        const Index surface = swept.quad_surface[q];
        if (surface == no_index) {
            throw UnmeshableError(ErrorCode::not_sweepable, "a part of the boundary belongs to no face");
        }
        const FaceId face =
            surface < caps ? body.cap_face(surface) : body.side_face(static_cast<Index>(surface - caps));
        result.quad_face.push_back(face);
        if (outward[swept.quad_solid[q]][face.index()] == 0) {
            std::swap(result.quads[q][1], result.quads[q][3]);
        }
    }
    return result;
}

/// One way to sweep and what came of it.
struct MultiSweepAttempt {
    Vec3 direction = Vec3::UnitZ();
    double merge = 0;          ///< MultiSweepOptions::merge
    double chord = 0;          ///< MultiSweepOptions::chord
    double quality = 0;        ///< least scaled Jacobian; meaningless with an error
    double face_distance = 0;  ///< of the boundary node farthest from its face
    std::string error;         ///< empty: a mesh was made
    Error::Ids tags;           ///< faces that the error names
};

struct BestMultiSweep {
    std::optional<MultiSweptModel> mesh;  ///< the best one, none if every attempt failed
    std::vector<MultiSweepAttempt> attempts;
};

/// Sweeps \p solids along each direction that recognise_extrusions() finds possible, best first, with the merging
/// tolerance of \p options, without merging, and, where that makes no mesh, with a twentieth of the chord error for
/// very short edges, until a mesh has a least scaled Jacobian of \p sufficient; otherwise the best counts. A mesh with a
/// boundary node farther from its face than 1e-4 times the size is none. Nothing is tried once out_of_time() is true.
/// Callables as for multi_sweep().
/// \throws UnmeshableError not_sweepable naming faces where no direction is possible; InputError as multi_sweep()
template <brep B, plane_imprinter I, class Solver, region_mesher M, class OutOfTime>
[[nodiscard]] BestMultiSweep best_multi_sweep(const B& b, std::span<const SolidId> solids,
                                              const MultiSweepOptions& options, I&& imprint, Solver&& solver,
                                              M&& mesher, OutOfTime&& out_of_time, double sufficient = 0.3,
                                              const LocalSizes& sizes = {}) {
    const std::vector<Extrusion> extrusions = recognise_extrusions(b, solids);
    if (extrusions.empty() || !extrusions.front().possible()) {
        throw extrusions.empty() ? UnmeshableError(ErrorCode::not_sweepable, "no face or edge gives a direction")
                                 : extrusion_error(b, extrusions.front());
    }
    BestMultiSweep result;
    double best = -2;
    for (const Extrusion& extrusion : extrusions) {
        for (const auto& [merge, chord] : {std::pair(options.merge, 1.0), {0.0, 1.0}, {0.0, 0.05}}) {
            const bool finer = chord < 1.0;
            if (!extrusion.possible() || best >= sufficient || (finer && best > 0) || out_of_time()) {
                continue;
            }
            MultiSweepOptions own = options;
            own.merge = merge;
            own.chord *= chord;
            MultiSweepAttempt attempt{extrusion.direction, merge, own.chord, 0, 0, {}, {}};
            try {
                MultiSweptModel mesh = multi_sweep_model(b, solids, extrusion, own, imprint, solver, mesher, sizes);
                const FaceDistance off = face_distance(b, mesh.mesh.nodes, mesh.quads, mesh.quad_face);
                if (off.distance > 1e-4 * options.size) {
                    const int tag = b.tag(2, mesh.quad_face[off.quad].index());
                    throw UnmeshableError(ErrorCode::not_sweepable,
                                          "a node of face " + std::to_string(tag) + " would lie " +
                                              std::to_string(off.distance) +
                                              " away from it, to keep clear of other faces nearby",
                                          {tag});
                }
                attempt.face_distance = off.distance;
                attempt.quality = hex_quality(mesh.mesh).scaled_jacobian.min;
                if (attempt.quality > best) {
                    best = attempt.quality;
                    result.mesh = std::move(mesh);
                }
            } catch (const InputError&) {
                throw;
            } catch (const Error& error) {
                attempt.error = error.what();
                attempt.tags = error.ids();
            }
            result.attempts.push_back(std::move(attempt));
        }
    }
    return result;
}

/// Why there is no mesh: what the first attempt says.
[[nodiscard]] inline UnmeshableError no_mesh_error(const BestMultiSweep& best) {
    if (best.attempts.empty()) {
        return {ErrorCode::not_sweepable, "no time was left to try a direction"};
    }
    const MultiSweepAttempt& first = best.attempts.front();
    const std::size_t colon = first.error.find(": ");
    return {ErrorCode::not_sweepable, colon == std::string::npos ? first.error : first.error.substr(colon + 2),
            first.tags};
}

}  // namespace pavior
