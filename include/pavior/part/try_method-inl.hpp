#pragma once

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/surface_distance.hpp>
#include <pavior/brep/all_tags.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/detail/part_text.hpp>
#include <pavior/part/detail/trial.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/judge_mesh.hpp>
#include <pavior/part/plane_guide.hpp>
#include <pavior/part/try_method.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <string>
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

/// Blocks of a solid in one reference mesh or another.
class BlockTries {
public:
    BlockTries(Trial& trial, SolidId solid)
        : trial_(trial), solid_(solid), has_others_(has_curved_face(trial.model, solid)) {
        options_.execution = trial.options.execution;
        options_.refine.emplace();
        const LocalLengths& local = trial.options.local;
        options_.refine->size = size_by_tag(trial.model, 3, solid.index(), local.solid).value_or(trial.size());
        options_.refine->max_angle = trial.options.max_angle;
        options_.refine->curve_size = local.edge;
        options_.refine->patch_size = local.face;
        if (has_others_) {
            options_.marking.max_work = 2.5e6;
        }
    }

    /// The best; rethrows what the first reference met if none has blocks.
    [[nodiscard]] BlockedModel run() {
        take(trial_.kernels.reference);
        for (const ReferenceMesher& other : trial_.kernels.other_references) {
            if (!has_others_ || quality_ >= trial_.options.sufficient || trial_.out_of_time()) {
                break;
            }
            take(other);
        }
        if (!best_) {
            std::rethrow_exception(reason_);
        }
        return std::move(*best_);
    }

private:
    void take(const ReferenceMesher& reference) {
        try {
            BlockedModel model = block_model(trial_.model, solid_, options_, reference);
            if (!best_ && !reason_) {
                trial_.describe(&model);
            }
            require_blocks(model.blocks);
            const HexMeshData data = block_mesh_data(model.blocks, model.reference.surface);
            const double quality = hex_quality(data.mesh, {10, options_.execution}).scaled_jacobian.min;
            if (!best_ || quality > quality_) {
                best_ = std::move(model);
                quality_ = quality;
                trial_.describe(&*best_);
            }
        } catch (const Error&) {
            if (!reason_) {
                reason_ = std::current_exception();
            }
        }
    }

    Trial& trial_;
    SolidId solid_;
    bool has_others_;
    BlockOptions options_;
    std::optional<BlockedModel> best_;
    double quality_ = -1;
    std::exception_ptr reason_;
};

inline void try_block(Trial& trial) {
    MethodTry& result = trial.result;
    if (trial.solids.size() != 1) {
        throw UnmeshableError(ErrorCode::invalid_dual,
                              "blocks are made of one solid, these are " + std::to_string(trial.solids.size()));
    }
    const BlockedModel model = BlockTries(trial, trial.solids[0]).run();
    if (model.shallow_creases) {
        result.notes.emplace_back("edges of less than 45 degrees are features, too, since all faces are plane");
    }
    result.notes.push_back(std::to_string(model.blocks.report.blocks.blocks) + " blocks");
    result.data = block_mesh_data(model.blocks, model.reference.surface);
    result.data.hex_groups.assign(result.data.mesh.hexes.size(), trial.model.tag(3, trial.solids[0].index()));
    result.data.groups = entity_groups(trial.model, trial.solids);
    result.hex_solid.assign(result.data.mesh.hexes.size(), trial.solids[0]);
    result.quad_face = faces_of_groups(trial.model, trial.solids[0], result.data.quad_groups);
    // Blocks unite faces that meet smoothly: a quad may stand for several of them.
    const TriMesh& surface = model.reference.surface.mesh;
    result.deviation.distance = model.reference.chord + surface_distance(result.data.mesh.nodes, result.data.quads,
                                                                         surface.nodes, surface.triangles);
}

/// Raises the least scaled Jacobian where it is low, also by sliding nodes on plane faces.
inline void improve(Trial& trial) {
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
}

inline void judge(Trial& trial, const std::function<bool()>& out_of_time) {
    const bool alone = trial.solids.size() == trial.model.solid_count();
    const JudgeOptions own{trial.options.execution, trial.size(), trial.options.imprint_tolerance, alone, out_of_time};
    const MeshCheck check = judge_mesh(trial.model, trial.solids, own, trial.result);
    const JudgedMesh judged{&trial.result.data, check, trial.result.deviation};
    trial.describe(&judged);
}

}  // namespace detail

PAVIOR_INLINE MethodTry try_method(PartMethod method, const AnyModel& model, std::span<const SolidId> solids,
                                   const PartOptions& options, const Kernels& kernels, const TryTimes& times) {
    MethodTry result;
    result.method = method;
    const Stopwatch watch;
    detail::Trial trial{model, solids, options, kernels, times.out_of_time, result};
    try {
        switch (method) {
            case PartMethod::submap: detail::try_submap(trial); break;
            case PartMethod::sweep: detail::try_sweep(trial); break;
            case PartMethod::multi_sweep: detail::try_multi_sweep(trial); break;
            case PartMethod::mixed: detail::try_mixed(trial); break;
            case PartMethod::block: detail::try_block(trial); break;
        }
        if (!times.out_of_time()) {
            detail::improve(trial);
        }
        if (times.made) {
            times.made();
        }
        detail::judge(trial, times.no_time_to_check);
    } catch (const Stopped&) {
        throw;
    } catch (const Error& error) {
        detail::refuse(result, error);
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

}  // namespace pavior
