#pragma once

#include <pavior/brep/join_solids.hpp>
#include <pavior/brep/joined_faces.hpp>
#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/part/detail/named_solids.hpp>
#include <pavior/part/mixed_model.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/multi_sweep_solids.hpp>
#include <pavior/part/solid_methods.hpp>
#include <pavior/part/sweep_groups.hpp>

#include <algorithm>
#include <array>
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
                if (!out_of_time_()) {
                    try {
                        return sweep_with_levels(way.groups);
                    } catch (const UnmeshableError& error) {
                        apart = apart ? apart : error;
                    }
                }
            }
            throw refusal(solids, together, apart);
        }
    }

private:
    [[nodiscard]] MultiSweptModel sweep_group(std::span<const SolidId> group, const BoundaryMesh* given) const {
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

    /// The mesh of all groups, each of which takes its levels at edges along its direction from the neighbours for
    /// which these edges lie in the plane, where other edges may end on them: as they divide them alone.
    [[nodiscard]] SolidsMesh sweep_with_levels(const std::vector<std::vector<SolidId>>& groups) const {
        std::vector<MultiSweptModel> alone;
        for (const std::vector<SolidId>& group : groups) {
            alone.push_back(sweep_group(group, nullptr));
        }
        SolidsMesh mesh;
        std::vector<SolidId> done;
        for (std::size_t at = 0; at < groups.size(); ++at) {
            const std::vector<SolidId>& group = groups[at];
            BoundaryMesh given =
                neighbour_boundary(b_, mesh.mesh.nodes, mesh.quads, mesh.quad_face, met_faces(b_, done, group));
            for (std::size_t k = at + 1; k < groups.size(); ++k) {
                const BoundaryMesh theirs = neighbour_boundary(b_, alone[k].mesh.nodes, alone[k].quads,
                                                               alone[k].quad_face, met_faces(b_, groups[k], group));
                for (const EdgeId e : solid_edges(b_, group).edges) {
                    if (given.edges[e.index()].nodes.empty() && runs_along(e, alone[at].path) &&
                        !runs_along(e, alone[k].path)) {
                        copy_edge(e, theirs, given);
                    }
                }
            }
            const SolidsMesh swept = sweep_group(group, &given);
            std::vector<Index> same = given_nodes(b_, group, swept, given);
            for (Index& id : same) {
                id = id < mesh.mesh.nodes.size() ? id : no_index;
            }
            join_solids(swept, same, given, mesh);
            done.insert(done.end(), group.begin(), group.end());
        }
        return mesh;
    }

    /// A straight path, and the edge along it.
    [[nodiscard]] bool runs_along(EdgeId e, const SweepPath& path) const {
        const auto range = b_.edge_range(e);
        const std::array parts{0.0, 0.5, 1.0};
        return !path.axis && path.ribs.empty() && std::all_of(parts.begin(), parts.end(), [&](double part) {
            const Vec3 along = b_.edge_derivative(e, range[0] + part * (range[1] - range[0]));
            return along.cross(path.direction).norm() <= 1e-3 * along.norm();
        });
    }

    /// Gives nodes on an edge that \p theirs has, new ones but for those at vertices that are given.
    void copy_edge(EdgeId e, const BoundaryMesh& theirs, BoundaryMesh& given) const {
        const EdgeNodes& from = theirs.edges[e.index()];
        EdgeNodes& to = given.edges[e.index()];
        to.parameters = from.parameters;
        for (std::size_t i = 0; i < from.nodes.size(); ++i) {
            if (i > 0 && i + 1 < from.nodes.size()) {
                to.nodes.push_back(given.add_node(theirs.nodes[from.nodes[i]]));
                continue;
            }
            Index& vertex = given.vertices[b_.edge_vertices(e)[i == 0 ? 0 : 1].index()];
            vertex = vertex == no_index ? given.add_node(theirs.nodes[from.nodes[i]]) : vertex;
            to.nodes.push_back(vertex);
        }
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
        submaps = recognise_submaps(b, choice.submaps, options.submap, kernels.solver);
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

/// Each solid by one of its \p ways, many-to-many if it has none. The better of two choices of methods where the first
/// is poor.
[[nodiscard]] inline MixedSolids mixed_by(const AnyModel& b, std::vector<SolidWays> ways, const MixedOptions& options,
                                          const Kernels& kernels, const std::function<bool()>& out_of_time) {
    std::vector<SolidId> many;
    std::vector<SolidId> others;
    for (const SolidWays& way : ways) {
        (way.only_multi_sweep() ? many : others).push_back(way.solid);
    }
    std::erase_if(ways, [](const SolidWays& way) { return way.only_multi_sweep(); });
    const GroupSweeper sweeper(b, options, kernels, out_of_time);
    MixedSolids base;
    for (const std::vector<SolidId>& group : touching_solids(b, many)) {
        append_solids(sweeper.sweep(group), base);
        for (const SolidId solid : group) {
            base.methods[solid] = PartMethod::multi_sweep;
        }
    }
    const BoundaryMesh given =
        neighbour_boundary(b, base.mesh.nodes, base.quads, base.quad_face, touched_faces(b, many, others));
    std::optional<MixedSolids> best;
    std::optional<UnmeshableError> refusal;
    double quality = 0;
    for (const bool prefer_submap : {true, false}) {
        if (best && (quality >= 0.2 || out_of_time())) {
            break;
        }
        try {
            MixedSolids mesh = base;
            add_mixed(b, ways, given, prefer_submap, options, kernels, mesh);
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

/// Adds sweeps whose sides run round corners of 270 degrees (StackingOptions::flat_notches): to solids that have no
/// other way and no direction to be swept many-to-many in, or to \p all. Whether there are any.
[[nodiscard]] inline bool add_flattened(const AnyModel& b, bool all, std::vector<SolidWays>& ways) {
    RecognitionOptions flat;
    flat.stacking.flat_notches = true;
    bool any = false;
    for (SolidWays& way : ways) {
        if (!all) {
            if (!way.only_multi_sweep()) {
                continue;
            }
            const std::vector<Extrusion> straight = recognise_extrusions(b, std::span(&way.solid, 1));
            if (!straight.empty() && straight.front().possible()) {
                continue;
            }
        }
        for (SweepTopology& sweep : recognise_sweeps(b, way.solid, flat).candidates) {
            const auto same = [&](const SweepTopology& known) {
                return known.source == sweep.source && known.target == sweep.target;
            };
            if (std::none_of(way.sweeps.begin(), way.sweeps.end(), same)) {
                way.sweeps.push_back(std::move(sweep));
                any = true;
            }
        }
    }
    return any;
}

/// The first mesh that is valid, or else the first, of what more and more ways to see the solids lead to. The first
/// refusal is kept.
class MixedAttempts {
public:
    MixedAttempts(const MixedOptions& options, const Kernels& kernels, const std::function<bool()>& out_of_time)
        : options_(options), kernels_(kernels), out_of_time_(out_of_time) {}

    [[nodiscard]] bool done() const { return valid_ || ((best_ || refusal_) && out_of_time_()); }

    /// Calls after(mesh) of a mesh made.
    template <class After>
    void run(const AnyModel& b, std::span<const SolidId> solids, After&& after) {
        std::vector<SolidWays> ways = solid_ways(b, solids, kernels_.solver, options_.submap);
        attempt(b, ways, after);
        for (const bool all : {false, true}) {
            if (!done() && add_flattened(b, all, ways)) {
                attempt(b, ways, after);
            }
        }
    }

    /// \throws UnmeshableError the first refusal if there is no mesh, but rather Error cad_failure, which another size
    /// may help
    [[nodiscard]] MixedSolids take() && {
        if (!best_ && failure_) {
            throw *failure_;
        }
        if (!best_) {
            throw *refusal_;
        }
        return std::move(*best_);
    }

private:
    template <class After>
    void attempt(const AnyModel& b, const std::vector<SolidWays>& ways, After&& after) {
        try {
            MixedSolids mesh = mixed_by(b, ways, options_, kernels_, out_of_time_);
            valid_ = hex_quality(mesh.mesh).scaled_jacobian.min > 0;
            if (valid_ || !best_) {
                after(mesh);
                best_ = std::move(mesh);
            }
        } catch (const UnmeshableError& error) {
            refusal_ = refusal_ ? refusal_ : error;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cad_failure || !(best_ || refusal_)) {
                throw;
            }
            failure_ = failure_ ? failure_ : error;
        }
    }

    const MixedOptions& options_;
    const Kernels& kernels_;
    const std::function<bool()>& out_of_time_;
    std::optional<MixedSolids> best_;
    std::optional<UnmeshableError> refusal_;
    std::optional<Error> failure_;  ///< of the CAD kernel
    bool valid_ = false;
};

/// Gives quads of joined faces back to the faces on which their middles lie.
inline void part_faces(const JoinedFaces<AnyModel>& joined, SolidsMesh& mesh) {
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (!joined.parts(mesh.quad_face[q]).empty()) {
            Vec3 middle = Vec3::Zero();
            for (const Index i : mesh.quads[q]) {
                middle += 0.25 * mesh.mesh.nodes[i];
            }
            const FaceId face = joined.part_at(mesh.quad_face[q], middle);
            if (!joined.same_sense(mesh.quad_face[q], face)) {
                std::swap(mesh.quads[q][1], mesh.quads[q][3]);
            }
            mesh.quad_face[q] = face;
        }
    }
}

}  // namespace detail

PAVIOR_INLINE MixedSolids mixed_solids(const AnyModel& b, std::span<const SolidId> solids, const MixedOptions& options,
                                       const Kernels& kernels, const std::function<bool()>& out_of_time) {
    detail::MixedAttempts attempts(options, kernels, out_of_time);
    attempts.run(b, solids, [](const MixedSolids&) {});
    if (!attempts.done()) {
        if (const JoinedFaces<AnyModel> joined(b); joined.any()) {
            attempts.run(AnyModel(joined), solids, [&](MixedSolids& mesh) { detail::part_faces(joined, mesh); });
        }
    }
    return std::move(attempts).take();
}

}  // namespace pavior
