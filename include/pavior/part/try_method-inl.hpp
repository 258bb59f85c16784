#pragma once

#include <pavior/block/block_mesh_data.hpp>
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

#include <exception>
#include <new>
#include <sstream>
#include <string>

namespace pavior {

namespace detail {

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
    const auto whole = local.solid.find(trial.model.tag(3, trial.solids[0].index()));
    own.refine->size = whole != local.solid.end() ? whole->second : trial.size();
    own.refine->curve_size = local.edge;
    own.refine->patch_size = local.face;
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

inline void judge(Trial& trial) {
    const auto [check, volume] = judge_mesh(trial.model, trial.solids, trial.options.execution, trial.result);
    const JudgedMesh judged{&trial.result.data, check, volume};
    trial.describe(&judged);
}

}  // namespace detail

PAVIOR_INLINE MethodTry try_method(PartMethod method, const AnyModel& model, std::span<const SolidId> solids,
                                   const PartOptions& options, const Kernels& kernels,
                                   const std::function<bool()>& out_of_time) {
    MethodTry result;
    result.method = method;
    const Stopwatch watch;
    detail::Trial trial{model, solids, options, kernels, out_of_time, result};
    try {
        switch (method) {
            case PartMethod::submap: detail::try_submap(trial); break;
            case PartMethod::sweep: detail::try_sweep(trial); break;
            case PartMethod::multi_sweep: detail::try_multi_sweep(trial); break;
            case PartMethod::mixed: detail::try_mixed(trial); break;
            case PartMethod::block: detail::try_block(trial); break;
        }
        if (!out_of_time()) {
            detail::improve(trial);
        }
        detail::judge(trial);
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
