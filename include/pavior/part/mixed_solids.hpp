#pragma once
/// \file
/// Touching solids, each meshed by the method that suits it, conforming.

#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/part/mixed_model.hpp>
#include <pavior/part/solid_methods.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct MixedOptions {
    double size = 0;   ///< wished length of mesh edges; must be given
    int min_loop = 4;  ///< intervals of a loop of a cap of a one-to-one sweep, at least
    LocalSizes sizes;
    Execution execution = sequential;
};

/// Hexahedra of a model with their entities: groups of many-to-many sweeps, swept solids, submapped solids.
struct MixedSolids : SolidsMesh {
    std::map<SolidId, SolidMethod> methods;
};

namespace detail {

/// Faces of \p done with an edge that one of \p others has, too.
template <brep B>
[[nodiscard]] std::vector<FaceId> touched_faces(const B& b, std::span<const SolidId> done,
                                                std::span<const SolidWays> others) {
    std::vector<bool> touched(b.edge_count(), false);
    const auto each_edge = [&](FaceId f, auto&& visit) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                visit(use.edge.index());
            }
        }
    };
    for (const SolidWays& other : others) {
        for (const OrientedFace& f : b.solid_faces(other.solid)) {
            each_edge(f.face, [&](std::size_t e) { touched[e] = true; });
        }
    }
    std::vector<FaceId> result;
    for (const SolidId solid : done) {
        for (const OrientedFace& f : b.solid_faces(solid)) {
            bool any = false;
            each_edge(f.face, [&](std::size_t e) { any = any || touched[e]; });
            if (any) {
                result.push_back(f.face);
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// Numbers and mesh of all solids but the groups, added to \p result.
template <brep B, integer_solver Solver, class C>
void add_mixed(const B& b, std::span<const SolidWays> ways, BoundaryMesh given, bool prefer_submap,
               const MixedOptions& options, Solver& solver, C&& cap_mesher, MixedSolids& result) {
    const MethodChoice choice = choose_methods(b, ways, given, prefer_submap);
    SubmapModel submaps;
    submaps.faces.resize(b.face_count());
    if (!choice.submaps.empty()) {
        submaps = recognise_submaps(b, choice.submaps, SubmapOptions{}, solver);
    }
    IntervalOptions wishes;
    wishes.size = options.size;
    wishes.min_loop = options.min_loop;
    wishes.edge_size = options.sizes.edge;
    wishes.face_size = options.sizes.face;
    wishes.solid_size = options.sizes.solid;
    wishes.edge_intervals = given_intervals(b, given);
    const SubmapIntervals numbers = assign_submap_intervals(b, choice.sweeps, submaps, wishes, LevelOptions{}, solver);
    MixedModelOptions how;
    how.sweep.solid.sweep.execution = options.execution;
    how.submap.execution = options.execution;
    extend_solids(mixed_model(b, choice.sweeps, submaps, numbers, cap_mesher, std::move(given), how), result);
    for (const SolidId solid : choice.submaps) {
        result.methods[solid] = SolidMethod::submap;
    }
    for (const SweepTopology& sweep : choice.sweeps) {
        result.methods[sweep.solid] = SolidMethod::sweep;
    }
}

}  // namespace detail

/// Meshes \p solids, which touch, each by its own method: those that are neither submappable nor one-to-one sweeps are
/// swept many-to-many first, those that touch together in one direction; the others are submapped or swept one-to-one,
/// with shared faces as they find them (choose_methods()), in one interval assignment. Callables as for
/// best_multi_sweep() and mixed_model().
/// The result is not verified; use verify_hexes(). Deterministic if the callables are, but for out_of_time().
/// \throws UnmeshableError naming faces if a solid admits no method, or none that fits its neighbours: many-to-many
/// sweeps of different directions that touch, faces with unstructured quads that no neighbour can sweep from;
/// InputError bad_option (size)
template <brep B, plane_imprinter I, integer_solver Solver, region_mesher M, cap_mesher C, class OutOfTime>
[[nodiscard]] MixedSolids mixed_solids(const B& b, std::span<const SolidId> solids, const MixedOptions& options,
                                       I&& imprint, Solver&& solver, M&& region_mesher, C&& cap_mesher,
                                       OutOfTime&& out_of_time) {
    std::vector<SolidWays> ways = solid_ways(b, solids, solver);
    std::vector<SolidId> many;
    for (const SolidWays& way : ways) {
        if (way.only_multi_sweep()) {
            many.push_back(way.solid);
        }
    }
    std::erase_if(ways, [](const SolidWays& way) { return way.only_multi_sweep(); });
    MultiSweepOptions sweep;
    sweep.size = options.size;
    sweep.execution = options.execution;
    MixedSolids base;
    for (const std::vector<SolidId>& group : touching_solids(b, many)) {
        BestMultiSweep swept =
            best_multi_sweep(b, group, sweep, imprint, solver, region_mesher, out_of_time, 0.3, options.sizes);
        if (!swept.mesh) {
            throw no_mesh_error(swept);
        }
        append_solids(*swept.mesh, base);
        for (const SolidId solid : group) {
            base.methods[solid] = SolidMethod::multi_sweep;
        }
    }
    const BoundaryMesh given =
        neighbour_boundary(b, base.mesh.nodes, base.quads, base.quad_face, detail::touched_faces(b, many, ways));
    std::optional<MixedSolids> best;
    std::optional<UnmeshableError> refusal;
    double quality = 0;
    for (const bool prefer_submap : {true, false}) {
        if (best && (quality >= 0.2 || out_of_time())) {
            break;
        }
        try {
            MixedSolids mesh = base;
            detail::add_mixed(b, ways, given, prefer_submap, options, solver, cap_mesher, mesh);
            const double own = hex_quality(mesh.mesh).scaled_jacobian.min;
            if (!best || own > quality) {
                quality = own;
                best = std::move(mesh);
            }
        } catch (const UnmeshableError& error) {
            refusal = refusal ? refusal : error;
        }
    }
    if (!best) {
        throw *refusal;
    }
    return std::move(*best);
}

}  // namespace pavior
