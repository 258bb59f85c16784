#pragma once

#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/part/mixed_model.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/multi_sweep_solids.hpp>
#include <pavior/part/solid_methods.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Faces of \p done with an edge that one of \p others has, too.
[[nodiscard]] inline std::vector<FaceId> touched_faces(const AnyModel& b, std::span<const SolidId> done,
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
inline void add_mixed(const AnyModel& b, std::span<const SolidWays> ways, BoundaryMesh given, bool prefer_submap,
                      const MixedOptions& options, const Kernels& kernels, MixedSolids& result) {
    const MethodChoice choice = choose_methods(b, ways, given, prefer_submap);
    SubmapModel submaps;
    submaps.faces.resize(b.face_count());
    if (!choice.submaps.empty()) {
        submaps = recognise_submaps(b, choice.submaps, SubmapOptions{}, kernels.solver);
    }
    IntervalOptions wishes;
    wishes.size = options.size;
    wishes.max_angle = options.max_angle;
    wishes.min_loop = options.min_loop;
    wishes.edge_size = options.sizes.edge;
    wishes.face_size = options.sizes.face;
    wishes.solid_size = options.sizes.solid;
    wishes.edge_intervals = given_intervals(b, given);
    const SubmapIntervals numbers =
        assign_submap_intervals(b, choice.sweeps, submaps, wishes, LevelOptions{}, kernels.solver);
    MixedModelOptions how;
    how.sweep.solid.sweep.execution = options.execution;
    how.submap.execution = options.execution;
    extend_solids(mixed_model(b, choice.sweeps, submaps, numbers, kernels.caps, std::move(given), how), result);
    for (const SolidId solid : choice.submaps) {
        result.methods[solid] = PartMethod::submap;
    }
    for (const SweepTopology& sweep : choice.sweeps) {
        result.methods[sweep.solid] = PartMethod::sweep;
    }
}

}  // namespace detail

PAVIOR_INLINE MixedSolids mixed_solids(const AnyModel& b, std::span<const SolidId> solids, const MixedOptions& options,
                                       const Kernels& kernels, const std::function<bool()>& out_of_time) {
    std::vector<SolidWays> ways = solid_ways(b, solids, kernels.solver);
    std::vector<SolidId> many;
    for (const SolidWays& way : ways) {
        if (way.only_multi_sweep()) {
            many.push_back(way.solid);
        }
    }
    std::erase_if(ways, [](const SolidWays& way) { return way.only_multi_sweep(); });
    MultiSweepOptions sweep;
    sweep.size = options.size;
    sweep.max_angle = options.max_angle;
    sweep.execution = options.execution;
    MixedSolids base;
    for (const std::vector<SolidId>& group : touching_solids(b, many)) {
        BestMultiSweep swept = multi_sweep_solids(b, group, sweep, kernels, out_of_time, options.sizes);
        if (!swept.mesh) {
            throw no_mesh_error(swept);
        }
        append_solids(*swept.mesh, base);
        for (const SolidId solid : group) {
            base.methods[solid] = PartMethod::multi_sweep;
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
            detail::add_mixed(b, ways, given, prefer_submap, options, kernels, mesh);
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
