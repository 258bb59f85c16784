#pragma once

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/surface_distance.hpp>
#include <pavior/brep/all_tags.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/decompose_solids.hpp>
#include <pavior/part/detail/part_text.hpp>
#include <pavior/part/detail/trial.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/judge_mesh.hpp>
#include <pavior/part/pillow_solids.hpp>
#include <pavior/part/plane_guide.hpp>
#include <pavior/part/settle_nodes.hpp>
#include <pavior/part/try_method.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace pavior {

namespace detail {

/// The faces of a solid that bear the tags, one a tag; empty if one of them bears none.
[[nodiscard]] inline std::vector<FaceId> faces_of_groups(const AnyModel& b, SolidId solid,
                                                         std::span<const std::int32_t> tags) {
    std::map<int, FaceId> by_tag;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        by_tag.emplace(b.tag(2, f.face.index()), f.face);
    }
    std::vector<FaceId> faces;
    for (const std::int32_t tag : tags) {
        const auto found = by_tag.find(tag);
        if (found == by_tag.end()) {
            return {};
        }
        faces.push_back(found->second);
    }
    return faces;
}

[[nodiscard]] inline bool has_curved_face(const AnyModel& b, SolidId solid) {
    const auto faces = b.solid_faces(solid);
    return std::any_of(faces.begin(), faces.end(), [&](const OrientedFace& f) { return !plane_of(b, f.face); });
}

/// Moves a mesh made on triangles onto the model.
inline void settle(Trial& trial) {
    MethodTry& result = trial.result;
    if (result.quad_face.size() != result.data.quads.size()) {
        return;
    }
    SolidsMesh mesh{std::move(result.data.mesh), std::move(result.hex_solid), std::move(result.data.quads),
                    std::move(result.quad_face)};
    SettleOptions own;
    own.size = trial.size();
    own.execution = trial.options.execution;
    const SettledNodes settled = settle_nodes(trial.model, mesh, own);
    if (settled.held > 0) {
        result.notes.push_back(std::to_string(settled.held) + " nodes of the boundary are off the model");
    }
    result.data.mesh = std::move(mesh.mesh);
    result.hex_solid = std::move(mesh.hex_solid);
    result.data.quads = std::move(mesh.quads);
    result.quad_face = std::move(mesh.quad_face);
}

inline void try_block(Trial& trial) {
    MethodTry& result = trial.result;
    if (trial.solids.size() != 1) {
        throw UnmeshableError(ErrorCode::invalid_dual,
                              "blocks are made of one solid, these are " + std::to_string(trial.solids.size()));
    }
    BlockOptions own;
    own.execution = trial.options.execution;
    own.refine.emplace();
    const LocalLengths& local = trial.options.local;
    own.refine->size = size_by_tag(trial.model, 3, trial.solids[0].index(), local.solid).value_or(trial.size());
    own.refine->max_angle = trial.options.max_angle;
    own.refine->curve_size = local.edge;
    own.refine->patch_size = local.face;
    if (!trial.kernels.other_references.empty() && has_curved_face(trial.model, trial.solids[0])) {
        own.marking.max_work = 2.5e6;
    }
    const BlockedModel model = block_model(trial.model, trial.solids[0], own, trial.kernels.reference);
    if (model.shallow_creases) {
        result.notes.emplace_back("edges of less than 45 degrees are features, too, since all faces are plane");
    }
    trial.describe(&model);
    require_blocks(model.blocks);
    result.notes.push_back(std::to_string(model.blocks.report.blocks.blocks) + " blocks");
    result.data = block_mesh_data(model.blocks, model.reference.surface);
    result.data.hex_groups.assign(result.data.mesh.hexes.size(), trial.model.tag(3, trial.solids[0].index()));
    result.data.groups = entity_groups(trial.model, trial.solids);
    result.hex_solid.assign(result.data.mesh.hexes.size(), trial.solids[0]);
    result.quad_face = faces_of_groups(trial.model, trial.solids[0], result.data.quad_groups);
    settle(trial);
    // Blocks unite faces that meet smoothly: a quad may stand for several of them.
    const auto surface = std::make_shared<const TriMesh>(model.reference.surface.mesh);
    trial.distance = [surface, chord = model.reference.chord](const HexMeshData& data) {
        return chord + surface_distance(data.mesh.nodes, data.quads, surface->nodes, surface->triangles);
    };
}

/// "a layer of hexahedra under faces 3, 5: least scaled Jacobian raised from 0.01 to 0.4".
[[nodiscard]] inline std::string note_of(const AnyModel& b, const PillowedSolids& pillowed) {
    std::ostringstream note;
    note.precision(3);
    const std::vector<FaceId>& faces = pillowed.attempts[*pillowed.taken].faces;
    if (faces.empty()) {
        note << "nodes slid on faces and edges";
    } else {
        note << "a layer of hexahedra under face" << (faces.size() == 1 ? " " : "s ");
        for (std::size_t i = 0; i < faces.size(); ++i) {
            note << (i == 0 ? "" : ", ") << b.tag(2, faces[i].index());
        }
    }
    note << ": least scaled Jacobian raised from " << pillowed.before << " to " << pillowed.after;
    return note.str();
}

/// Nodes slide on faces and edges, and layers of hexahedra come under faces, where that raises the least scaled
/// Jacobian and leaves the boundary as near to the model as it is.
inline void insert_layers(Trial& trial, double enough) {
    constexpr double as_near = 0.05;  // of the size
    MethodTry& result = trial.result;
    PillowSolidsOptions own;
    own.size = trial.size();
    own.enough = enough;
    own.out_of_time = trial.out_of_time;
    own.execution = trial.options.execution;
    SolidsMesh mesh{result.data.mesh, result.hex_solid, result.data.quads, result.quad_face};
    const PillowedSolids pillowed = pillow_solids(trial.model, mesh, own);
    if (!pillowed.taken) {
        return;
    }
    HexMeshData made;
    made.mesh = std::move(mesh.mesh);
    made.quads = std::move(mesh.quads);
    const auto distance = [&](const HexMeshData& data, const std::vector<FaceId>& faces) {
        return trial.distance
                   ? trial.distance(data)
                   : cad_deviation(trial.model, trial.solids, data.mesh.nodes, data.quads, faces, 0, own.size)
                         .distance.value_or(0);
    };
    if (distance(made, mesh.quad_face) > distance(result.data, result.quad_face) + as_near * own.size) {
        return;
    }
    result.notes.push_back(note_of(trial.model, pillowed));
    result.hex_solid = std::move(mesh.hex_solid);
    result.quad_face = std::move(mesh.quad_face);
    for (const SolidId solid : result.hex_solid) {
        made.hex_groups.push_back(trial.model.tag(3, solid.index()));
    }
    for (const FaceId face : result.quad_face) {
        made.quad_groups.push_back(trial.model.tag(2, face.index()));
    }
    made.groups = std::move(result.data.groups);
    result.data = std::move(made);
}

/// Raises the least scaled Jacobian where it is low, also by sliding nodes on plane faces, and by \p layers where
/// asked.
inline void improve(Trial& trial, bool layers) {
    constexpr double enough = 0.3;
    const Execution& execution = trial.options.execution;
    HexMeshData& data = trial.result.data;
    const double before = hex_quality(data.mesh, {10, execution}).scaled_jacobian.min;
    if (before >= enough || data.quad_groups.size() != data.quads.size()) {
        return;
    }
    ImproveOptions own;
    own.target = 0.5;
    own.sufficient = enough;
    own.effort = 30;
    own.execution = execution;
    const PlaneGuide guide(trial.model, data);
    const SmoothReport report =
        improve_hexes(std::span(data.mesh.nodes), std::span<const HexCorners>(data.mesh.hexes), guide, own);
    trial.describe(&report);
    const double after = hex_quality(data.mesh, {10, execution}).scaled_jacobian.min;
    if (after > before) {
        std::ostringstream note;
        note << "least scaled Jacobian raised from " << before << " by sliding nodes on plane faces";
        trial.result.notes.push_back(note.str());
    }
    if (layers && after < enough && !trial.out_of_time() && trial.result.quad_face.size() == data.quads.size()) {
        try {
            insert_layers(trial, enough);
        } catch (const InputError&) {  // it does not hang together: to be judged as it is
        }
    }
}

inline void judge(Trial& trial, const std::function<bool()>& out_of_time) {
    const bool alone = trial.solids.size() == trial.model.solid_count();
    const JudgeOptions own{trial.options.execution, trial.size(), trial.options.imprint_tolerance, alone, out_of_time};
    const MeshCheck check = judge_mesh(trial.model, trial.solids, own, trial.result);
    const JudgedMesh judged{&trial.result.data, check, trial.result.deviation};
    trial.describe(&judged);
}

inline void try_decompose(Trial& trial);

[[nodiscard]] inline MethodTry try_once(PartMethod method, const AnyModel& model, std::span<const SolidId> solids,
                                        const PartOptions& options, const Kernels& kernels, const TryTimes& times,
                                        bool layers = true, SubmapOptions submap = {}) {
    MethodTry result;
    result.method = method;
    const Stopwatch watch;
    Trial trial{model, solids, options, kernels, times.out_of_time, result, times.seconds, {}, std::move(submap)};
    try {
        switch (method) {
            case PartMethod::submap: try_submap(trial); break;
            case PartMethod::sweep: try_sweep(trial); break;
            case PartMethod::multi_sweep: try_multi_sweep(trial); break;
            case PartMethod::mixed: try_mixed(trial); break;
            case PartMethod::block: try_block(trial); break;
            case PartMethod::split: try_split(trial); break;
            case PartMethod::decompose: try_decompose(trial); break;
        }
        if (method != PartMethod::split && !times.out_of_time()) {  // which has done its own, and more
            improve(trial, layers);
        }
        if (trial.distance) {
            result.deviation.distance = trial.distance(result.data);
        }
        if (times.made) {
            times.made();
        }
        judge(trial, times.no_time_to_check);
    } catch (const Stopped&) {
        throw;
    } catch (const Error& error) {
        refuse(result, error);
    } catch (const std::bad_alloc&) {
        result.outcome = TryOutcome::died;
        result.reason = "not enough memory";
    } catch (const std::exception& error) {
        result.outcome = TryOutcome::died;
        result.reason = error.what();
    }
    result.seconds = watch.total();
    return result;
}

inline void try_decompose(Trial& trial) {
    if (!trial.kernels.cut) {
        throw std::logic_error("there is nothing to cut solids with");  // as any kernel that is not there
    }
    Kernels own_kernels = trial.kernels;
    own_kernels.describe = nullptr;
    const PieceMesher mesh = [&](PartMethod method, const ModelPieces& pieces, std::span<const SolidId> solids) {
        own_kernels.caps = pieces.caps;
        TryTimes times;
        times.out_of_time = trial.out_of_time;
        times.no_time_to_check = [] { return true; };  // the whole is checked
        return try_once(method, *pieces.model, solids, trial.options, own_kernels, times, !pieces.turns.empty(),
                        SubmapOptions{{}, pieces.turns});
    };
    CutSearchOptions own;
    own.sufficient = trial.options.sufficient;
    own.stop = trial.options.execution.stop;
    DecomposedSolids found = decompose_solids(trial.model, trial.solids, trial.kernels.cut, trial.kernels.solver, mesh,
                                              trial.out_of_time, own);
    trial.describe(&found);
    MethodTry& result = trial.result;
    if (found.mesh.outcome != TryOutcome::mesh) {
        throw not_decomposed(found.search);
    }
    result.cuts = std::move(found.search.cuts);
    for (const SolidCut& cut : result.cuts) {
        result.notes.push_back("cut at a " + text_of(cut));
    }
    result.notes.push_back(std::to_string(found.methods.size()) + " pieces, by " +
                           std::string(to_string(found.mesh.method)));
    result.data = std::move(found.mesh.data);
    result.hex_solid = std::move(found.mesh.hex_solid);
    result.quad_face = std::move(found.mesh.quad_face);
}

/// Asks for a stop when the time of a try is over or the caller asks for one.
class StopInTime {
public:
    StopInTime(const std::function<bool()>& out_of_time, const std::stop_token& callers)
        : watcher_([this, &out_of_time, callers](const std::stop_token& over) {
              while (!over.stop_requested() && !source_.stop_requested()) {
                  if (callers.stop_requested() || out_of_time()) {
                      source_.request_stop();
                  }
                  std::this_thread::sleep_for(std::chrono::milliseconds(20));
              }
          }) {}
    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

private:
    std::stop_source source_;
    std::jthread watcher_;
};

[[nodiscard]] inline bool better(const MethodTry& a, const MethodTry& b) {
    const bool is_mesh = a.outcome == TryOutcome::mesh;
    return is_mesh != (b.outcome == TryOutcome::mesh) ? is_mesh : is_mesh && a.min_jacobian > b.min_jacobian;
}

/// Blocks in one reference mesh after the other until they suffice; a mesh that is made is kept when the time is over.
[[nodiscard]] inline MethodTry try_references(const AnyModel& model, std::span<const SolidId> solids,
                                              const PartOptions& options, const Kernels& kernels,
                                              const TryTimes& times) {
    TryTimes own = times;
    own.made = nullptr;  // others may follow
    MethodTry best = try_once(PartMethod::block, model, solids, options, kernels, own);
    for (const ReferenceMesher& other : kernels.other_references) {
        const bool is_mesh = best.outcome == TryOutcome::mesh;
        if ((is_mesh && best.min_jacobian >= options.sufficient) || times.out_of_time()) {
            break;
        }
        Kernels others = kernels;
        others.reference = other;
        std::optional<StopInTime> limit;
        PartOptions within = options;
        if (is_mesh) {
            limit.emplace(times.out_of_time, options.execution.stop);
            within.execution.stop = limit->token();
        }
        try {
            MethodTry next = try_once(PartMethod::block, model, solids, within, others, own);
            if (better(next, best)) {
                best = std::move(next);
            }
        } catch (const Stopped&) {
            check_stop(options.execution.stop);
            break;
        }
    }
    if (times.made) {
        times.made();
    }
    return best;
}

}  // namespace detail

PAVIOR_INLINE MethodTry try_method(PartMethod method, const AnyModel& model, std::span<const SolidId> solids,
                                   const PartOptions& options, const Kernels& kernels, const TryTimes& times) {
    const bool several = method == PartMethod::block && !kernels.other_references.empty() && solids.size() == 1 &&
                         detail::has_curved_face(model, solids[0]);
    const Stopwatch watch;
    MethodTry result = several ? detail::try_references(model, solids, options, kernels, times)
                               : detail::try_once(method, model, solids, options, kernels, times);
    result.seconds = watch.total();
    return result;
}

}  // namespace pavior
