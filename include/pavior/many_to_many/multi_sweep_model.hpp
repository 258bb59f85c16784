#pragma once
/// \file
/// Many-to-many sweep of the solids of a CAD model.

#include <pavior/brep/face_distance.hpp>
#include <pavior/brep/join_solids.hpp>
#include <pavior/brep/snap_to_faces.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/brep_body.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/many_to_many/revolution.hpp>
#include <pavior/many_to_many/sweep_paths.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// What solids are swept along: a direction, a circle round an axis, or a curve parallel to edges.
struct SweepPath {
    Vec3 direction = Vec3::UnitZ();  ///< of a straight path
    std::optional<Axis> axis;        ///< of a path round it
    EdgeChain ribs;                  ///< of a path parallel to them; sweep_paths()
};

/// Hexahedra of a model with their entities, and how they were swept.
struct MultiSweptModel : SolidsMesh {
    SweepPath path;
    MultiSweepReport report;
};

/// Meshes \p solids of \p b, one conforming mesh for all, along the direction of \p extrusion. Callables as for
/// multi_sweep(). What \p given holds of the boundary (neighbour_boundary(); null: nothing) is kept, as far as columns
/// can; join_solids() tells.
/// \throws UnmeshableError not_sweepable naming faces; what multi_sweep() throws
template <brep B, plane_imprinter I, integer_solver Solver, region_mesher M>
[[nodiscard]] MultiSweptModel multi_sweep_model(const B& b, std::span<const SolidId> solids, const Extrusion& extrusion,
                                                const MultiSweepOptions& options, I&& imprint, Solver&& solver,
                                                M&& mesher, const LocalSizes& sizes = {},
                                                const BoundaryMesh* given = nullptr) {
    const BrepBody<B> body(b, solids, extrusion, options.chord * options.size,
                           std::max(options.merge, 0.1) * options.size, sizes, given);
    if (body.body().caps.empty()) {
        throw UnmeshableError(ErrorCode::not_sweepable, "no face is a cap");
    }
    MultiSweepMesh swept =
        multi_sweep(body.body(), body, options, std::ref(imprint), std::ref(solver), std::ref(mesher));
    MultiSweptModel result;
    result.mesh = std::move(swept.mesh);
    result.quads = std::move(swept.quads);
    result.path.direction = extrusion.direction;
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
    SweepPath path;
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

namespace detail {

/// Tries paths, the better mesh stays.
template <brep B, plane_imprinter I, integer_solver Solver, region_mesher M, class OutOfTime>
class MultiSweepSearch {
public:
    MultiSweepSearch(const B& b, std::span<const SolidId> solids, const MultiSweepOptions& options, I& imprint,
                     Solver& solver, M& mesher, OutOfTime& out_of_time, double sufficient, const LocalSizes& sizes,
                     const BoundaryMesh* given)
        : b_(b),
          solids_(solids),
          options_(options),
          imprint_(imprint),
          solver_(solver),
          mesher_(mesher),
          out_of_time_(out_of_time),
          sufficient_(sufficient),
          sizes_(sizes),
          given_(given) {}

    [[nodiscard]] bool found() const { return result_.mesh.has_value(); }
    [[nodiscard]] bool done() const { return best_ >= sufficient_ || out_of_time_(); }

    void straight(const Extrusion& extrusion) {
        attempts({extrusion.direction, {}, {}}, [&](const MultiSweepOptions& own) {
            return multi_sweep_model(b_, solids_, extrusion, own, imprint_, solver_, mesher_, sizes_, given_);
        });
    }

    /// A path round \p axis, if the solids admit one.
    void round(const Axis& axis) {
        const Unrolling any(axis, axis.direction.unitOrthogonal(), options_.size);
        if (!is_extrusion(UnrolledBrep(b_, any), solids_, Vec3::UnitY(), {1e-3, 89.9})) {
            return;
        }
        if (const auto map = unroll_round(b_, solids_, axis, options_.size, options_.max_angle)) {
            unrolled(*map, {Vec3::UnitY(), axis, {}}, {});
        }
    }

    /// A path along \p ribs, if the solids admit one. Whether there is one.
    bool along(const EdgeChain& ribs) {
        // CAD kernels approximate what is swept along a spline
        const ExtrusionOptions roles{2e-2, ExtrusionOptions{}.max_slope};
        const Spine any = spine_of(b_, ribs, 0.0);
        if (!is_extrusion(UnrolledBrep(b_, any), solids_, Vec3::UnitZ(), {roles.side_tolerance, 89.9})) {
            return false;
        }
        const auto map = spine_along(b_, solids_, ribs, options_.size, options_.max_angle);
        return map && unrolled(*map, {Vec3::UnitZ(), {}, ribs}, roles);
    }

    [[nodiscard]] BestMultiSweep take() && { return std::move(result_); }

private:
    /// Along path.direction in the coordinates of \p map, if every face is a cap or a side there. Whether they are.
    template <path_coordinates Map>
    bool unrolled(const Map& map, const SweepPath& path, const ExtrusionOptions& roles) {
        const UnrolledBrep view(b_, map);
        const Extrusion extrusion = extrusion_along(view, solids_, path.direction, roles);
        if (!extrusion.possible()) {
            return false;
        }
        attempts(path, [&](const MultiSweepOptions& own) {
            MultiSweptModel mesh =
                multi_sweep_model(view, solids_, extrusion, own, imprint_, solver_, mesher_, sizes_, given_);
            for (Vec3& node : mesh.mesh.nodes) {
                node = map.rolled(node);
            }
            if (!path.ribs.empty()) {
                snap_to_faces(b_, mesh.mesh.nodes, mesh.quads, mesh.quad_face, 1e-2 * options_.size);
            }
            mesh.path = path;
            return mesh;
        });
        return true;
    }

    template <class Sweep>
    void attempts(const SweepPath& path, Sweep&& sweep) {
        for (const auto& [merge, chord] : {std::pair(options_.merge, 1.0), {0.0, 1.0}, {0.0, 0.05}}) {
            const bool finer = chord < 1.0;
            if (done() || (finer && best_ > 0)) {
                continue;
            }
            MultiSweepOptions own = options_;
            own.merge = merge;
            own.chord *= chord;
            MultiSweepAttempt attempt{path, merge, own.chord, 0.0, 0.0, {}, {}};
            try {
                take(sweep(own), attempt);
            } catch (const InputError&) {
                throw;
            } catch (const Error& error) {
                attempt.error = error.what();
                attempt.tags = error.ids();
            }
            result_.attempts.push_back(std::move(attempt));
        }
    }

    void take(MultiSweptModel mesh, MultiSweepAttempt& attempt) {
        const FaceDistance off = face_distance(b_, mesh.mesh.nodes, mesh.quads, mesh.quad_face);
        if (off.distance > 1e-4 * options_.size + options_.off_face) {
            const int tag = b_.tag(2, mesh.quad_face[off.quad].index());
            throw UnmeshableError(ErrorCode::not_sweepable,
                                  "a node of face " + std::to_string(tag) + " would lie " +
                                      std::to_string(off.distance) +
                                      " away from it, to keep clear of other faces nearby",
                                  {tag});
        }
        if (given_ != nullptr) {
            (void)given_nodes(b_, solids_, mesh, *given_);
        }
        attempt.face_distance = off.distance;
        attempt.quality = hex_quality(mesh.mesh).scaled_jacobian.min;
        if (attempt.quality > best_) {
            best_ = attempt.quality;
            result_.mesh = std::move(mesh);
        }
    }

    const B& b_;
    std::span<const SolidId> solids_;
    const MultiSweepOptions& options_;
    I& imprint_;
    Solver& solver_;
    M& mesher_;
    OutOfTime& out_of_time_;
    double sufficient_;
    const LocalSizes& sizes_;
    const BoundaryMesh* given_;
    BestMultiSweep result_;
    double best_ = -2;
};

}  // namespace detail

/// Sweeps \p solids along each path on which every face is a cap or a side: the directions that recognise_extrusions()
/// finds possible, best first, then circles round the axes of their faces (revolution_axes(), unroll_round()), then,
/// if there is no mesh yet, a curve parallel to their edges (sweep_paths(), spine_along(); boundary nodes are snapped
/// to the faces, which CAD kernels approximate there). Each is tried with the merging tolerance of \p options, without
/// merging, and, where that makes no mesh, with a twentieth of the chord error for very short edges, until a mesh has
/// a least scaled Jacobian of \p sufficient; otherwise the best counts. A mesh with a boundary node farther from its
/// face than 1e-4 times the size is none, nor is one that differs from what is \p given of its boundary
/// (given_nodes(); null: nothing is). Nothing is tried once out_of_time() is true. Callables as for multi_sweep().
/// \throws UnmeshableError not_sweepable naming faces where no path is possible; InputError as multi_sweep()
template <brep B, plane_imprinter I, integer_solver Solver, region_mesher M, class OutOfTime>
[[nodiscard]] BestMultiSweep best_multi_sweep(const B& b, std::span<const SolidId> solids,
                                              const MultiSweepOptions& options, I&& imprint, Solver&& solver,
                                              M&& mesher, OutOfTime&& out_of_time, double sufficient = 0.3,
                                              const LocalSizes& sizes = {}, const BoundaryMesh* given = nullptr) {
    detail::MultiSweepSearch search(b, solids, options, imprint, solver, mesher, out_of_time, sufficient, sizes, given);
    const std::vector<Extrusion> extrusions = recognise_extrusions(b, solids);
    for (const Extrusion& extrusion : extrusions) {
        if (extrusion.possible() && !search.done()) {
            search.straight(extrusion);
        }
    }
    for (const Axis& axis : search.done() ? std::vector<Axis>{} : revolution_axes(b, solids)) {
        search.round(axis);
    }
    if (!search.found()) {
        for (const EdgeChain& ribs : sweep_paths(b, solids)) {
            if (search.done() || search.along(ribs)) {
                break;
            }
        }
    }
    BestMultiSweep result = std::move(search).take();
    if (result.attempts.empty() && (extrusions.empty() || !extrusions.front().possible())) {
        throw extrusions.empty() ? UnmeshableError(ErrorCode::not_sweepable, "no face or edge gives a direction")
                                 : extrusion_error(b, extrusions.front());
    }
    return result;
}

/// Why there is no mesh: what the first attempt says.
[[nodiscard]] PAVIOR_INLINE UnmeshableError no_mesh_error(const BestMultiSweep& best);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/multi_sweep_model-inl.hpp>
#endif
