#pragma once

#include <pavior/brep/join_solids.hpp>
#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/part/detail/named_solids.hpp>
#include <pavior/part/mixed_model.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/multi_sweep_solids.hpp>
#include <pavior/part/solid_methods.hpp>
#include <pavior/part/sweep_groups.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Faces of \p done with an edge that one of \p others has, too.
[[nodiscard]] inline std::vector<FaceId> touched_faces(const AnyModel& b, std::span<const SolidId> done,
                                                       std::span<const SolidId> others) {
    std::vector<bool> touched(b.edge_count(), false);
    const auto each_edge = [&](FaceId f, auto&& visit) {
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                visit(use.edge.index());
            }
        }
    };
    for (const SolidId other : others) {
        for (const OrientedFace& f : b.solid_faces(other)) {
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

/// Faces of \p done with a vertex that one of \p others has, too.
[[nodiscard]] inline std::vector<FaceId> met_faces(const AnyModel& b, std::span<const SolidId> done,
                                                   std::span<const SolidId> others) {
    const std::vector<VertexId> met = solid_edges(b, others).vertices;
    std::vector<FaceId> result;
    for (const SolidId solid : done) {
        for (const OrientedFace& f : b.solid_faces(solid)) {
            bool any = false;
            for (const EdgeLoop& loop : b.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    for (const VertexId v : b.edge_vertices(use.edge)) {
                        any = any || std::binary_search(met.begin(), met.end(), v);
                    }
                }
            }
            if (any) {
                result.push_back(f.face);
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// Sweeps many-to-many: solids that touch together where they have one direction, else group by group, the later ones
/// with the nodes that the earlier ones have made.
class GroupSweeper {
public:
    GroupSweeper(const AnyModel& b, const MixedOptions& options, const Kernels& kernels,
                 const std::function<bool()>& out_of_time)
        : b_(b), options_(options), kernels_(kernels), out_of_time_(out_of_time) {
        sweep_.size = options.size;
        sweep_.max_angle = options.max_angle;
        sweep_.execution = options.execution;
    }

    /// \throws UnmeshableError naming the solids that stand in the way
    [[nodiscard]] SolidsMesh sweep(std::span<const SolidId> solids) const {
        try {
            return sweep_group(solids, nullptr);
        } catch (const UnmeshableError& together) {
            if (solids.size() == 1) {
                throw UnmeshableError(together.code(),
                                      solid_list(b_, solids) +
                                          ", which can be neither submapped nor swept one-to-one, is no many-to-many "
                                          "sweep: " +
                                          message_of(together),
                                      together.ids());
            }
            std::optional<UnmeshableError> apart;
            for (const SweepGroups& way : sweep_groups(b_, solids)) {
                if (way.groups.size() == 1 || (apart && out_of_time_())) {
                    continue;
                }
                if (std::optional<SolidsMesh> mesh = sweep_in_order(way.groups, apart)) {
                    return std::move(*mesh);
                }
            }
            throw refusal(solids, together, apart);
        }
    }

private:
    [[nodiscard]] SolidsMesh sweep_group(std::span<const SolidId> group, const BoundaryMesh* given) const {
        BestMultiSweep swept = multi_sweep_solids(b_, group, sweep_, kernels_, out_of_time_, options_.sizes, given);
        if (!swept.mesh) {
            throw no_mesh_error(swept);
        }
        return std::move(*swept.mesh);
    }

    /// The mesh of all groups; a group that cannot take what the earlier ones give comes first then. Nothing, and the
    /// first reason, if no such order does.
    [[nodiscard]] std::optional<SolidsMesh> sweep_in_order(std::vector<std::vector<SolidId>> groups,
                                                           std::optional<UnmeshableError>& reason) const {
        for (std::set<std::vector<std::vector<SolidId>>> tried; tried.insert(groups).second;) {
            SolidsMesh mesh;
            std::vector<SolidId> done;
            std::size_t at = 0;
            try {
                for (; at < groups.size(); ++at) {
                    add_group(groups[at], done, mesh);
                }
                return mesh;
            } catch (const UnmeshableError& error) {
                const std::string swept = groups[at].size() > 1 ? ", which would be swept together: " : ": ";
                reason = reason ? reason
                                : UnmeshableError(error.code(), solid_list(b_, groups[at]) + swept + message_of(error),
                                                  error.ids());
                if (at == 0 || out_of_time_()) {
                    return std::nullopt;
                }
                std::rotate(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(at),
                            groups.begin() + static_cast<std::ptrdiff_t>(at) + 1);
            }
        }
        return std::nullopt;
    }

    /// Adds the mesh of \p group, which keeps the nodes that \p mesh has of \p done.
    void add_group(const std::vector<SolidId>& group, std::vector<SolidId>& done, SolidsMesh& mesh) const {
        const std::vector<FaceId> met = met_faces(b_, done, group);
        if (met.empty()) {
            append_solids(sweep_group(group, nullptr), mesh);
        } else {
            const BoundaryMesh given = neighbour_boundary(b_, mesh.mesh.nodes, mesh.quads, mesh.quad_face, met);
            const SolidsMesh swept = sweep_group(group, &given);
            join_solids(swept, given_nodes(b_, group, swept, given), given, mesh);
        }
        done.insert(done.end(), group.begin(), group.end());
    }

    [[nodiscard]] UnmeshableError refusal(std::span<const SolidId> solids, const UnmeshableError& together,
                                          const std::optional<UnmeshableError>& apart) const {
        std::string text = solid_list(b_, solids) +
                           ", which touch and can be neither submapped nor swept one-to-one, are no many-to-many "
                           "sweep together: " +
                           message_of(together);
        Error::Ids ids = together.ids();
        if (apart) {
            text += "\n  nor one by one: " + message_of(*apart);
            ids.insert(ids.end(), apart->ids().begin(), apart->ids().end());
        }
        return {together.code(), text, ids};
    }

    const AnyModel& b_;
    const MixedOptions& options_;
    const Kernels& kernels_;
    const std::function<bool()>& out_of_time_;
    MultiSweepOptions sweep_;
};

/// Numbers and mesh of solids whose methods are chosen, added to \p result.
inline void add_chosen(const AnyModel& b, const MethodChoice& choice, BoundaryMesh given, const MixedOptions& options,
                       const Kernels& kernels, MixedSolids& result) {
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

/// Numbers and mesh of all solids but the groups, added to \p result.
inline void add_mixed(const AnyModel& b, std::span<const SolidWays> ways, BoundaryMesh given, bool prefer_submap,
                      const MixedOptions& options, const Kernels& kernels, MixedSolids& result) {
    const MethodChoice choice = choose_methods(b, ways, given, prefer_submap);
    std::vector<SolidId> solids;
    for (const SolidWays& way : ways) {
        solids.push_back(way.solid);
    }
    try {
        add_chosen(b, choice, std::move(given), options, kernels, result);
    } catch (const UnmeshableError& error) {
        throw naming_solids(b, solids, error);
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
    const detail::GroupSweeper sweeper(b, options, kernels, out_of_time);
    MixedSolids base;
    for (const std::vector<SolidId>& group : touching_solids(b, many)) {
        append_solids(sweeper.sweep(group), base);
        for (const SolidId solid : group) {
            base.methods[solid] = PartMethod::multi_sweep;
        }
    }
    std::vector<SolidId> others;
    for (const SolidWays& way : ways) {
        others.push_back(way.solid);
    }
    const BoundaryMesh given =
        neighbour_boundary(b, base.mesh.nodes, base.quads, base.quad_face, detail::touched_faces(b, many, others));
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
