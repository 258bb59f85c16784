#pragma once
/// \file
/// One method on some solids of a model, from recognition to judgement.

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/detail/finer_sizes.hpp>
#include <pavior/part/detail/part_text.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/judge_mesh.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/part/plane_guide.hpp>
#include <pavior/part/sweep_solids.hpp>
#include <pavior/smooth/improve_hexes.hpp>
#include <pavior/submap/submap_model.hpp>

#include <exception>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>

namespace pavior {

namespace detail {

/// The methods on one set of solids.
template <brep B, class K>
class MethodTrier {
public:
    MethodTrier(const B& b, std::span<const SolidId> solids, const PartOptions& options, K& kernels, MethodTry& result)
        : b_(b), solids_(solids), options_(options), kernels_(kernels), result_(result) {
        wishes_.size = options.size > 0 ? options.size : diagonal_of(b) / 12;
        wishes_.edge_size = options.edge_size;
        wishes_.face_size = options.face_size;
        wishes_.solid_size = options.solid_size;
    }

    void submap() {
        SubmappedMesh mesh = submap_model(b_, solids_, wishes_, kernels_.solver);
        kernels_.describe(result_.report, b_, mesh);
        for (const SubmapSolidReport& solid : mesh.solids) {
            result_.notes.push_back(note_of(solid));
        }
        result_.data = grouped(b_, solids_, std::move(mesh));
    }

    void sweep() {
        SweepSolidsOptions own;
        own.intervals = wishes_;
        own.sweep.solid.sweep.execution = options_.execution;
        SweptSolids swept = sweep_solids(b_, solids_, own, kernels_.solver, kernels_.caps);
        kernels_.describe(result_.report, b_, swept);
        result_.warnings = std::move(swept.warnings);
        for (const SolidReport& solid : swept.mesh.solids) {
            result_.notes.push_back("from face " + std::to_string(b_.tag(2, solid.source.index())) + " to face " +
                                    std::to_string(b_.tag(2, solid.target.index())) + " in " +
                                    std::to_string(solid.layers) + " layers");
        }
        result_.data = grouped(b_, solids_, std::move(swept.mesh));
    }

    template <class OutOfTime>
    void multi_sweep(OutOfTime& out_of_time) {
        MultiSweepOptions own;
        own.size = wishes_.size;
        own.execution = options_.execution;
        BestMultiSweep best = best_multi_sweep(b_, solids_, own, kernels_.imprint, kernels_.solver, kernels_.regions,
                                               out_of_time, 0.3, local_sizes());
        kernels_.describe(result_.report, b_, best);
        for (const MultiSweepAttempt& attempt : best.attempts) {
            result_.notes.push_back(note_of(attempt, edge_tags(attempt.path.ribs)));
        }
        if (!best.mesh) {
            throw no_mesh_error(best);
        }
        result_.data = grouped(b_, solids_, std::move(*best.mesh));
    }

    template <class OutOfTime>
    void mixed(OutOfTime& out_of_time) {
        MixedOptions own;
        own.execution = options_.execution;
        own.sizes = local_sizes();
        MixedSolids mesh;
        with_finer_sizes(wishes_.size, result_.warnings, [&](double size, int min_loop) {
            own.size = size;
            own.min_loop = min_loop;
            mesh = mixed_solids(b_, solids_, own, kernels_.imprint, kernels_.solver, kernels_.regions, kernels_.caps,
                                out_of_time);
        });
        kernels_.describe(result_.report, b_, mesh);
        for (const auto& [solid, method] : mesh.methods) {
            result_.notes.push_back("solid " + std::to_string(b_.tag(3, solid.index())) + ": " +
                                    std::string(to_string(method)));
        }
        result_.data = grouped(b_, solids_, std::move(mesh));
    }

    void block() {
        if (solids_.size() != 1) {
            throw UnmeshableError(ErrorCode::invalid_dual,
                                  "blocks are made of one solid, these are " + std::to_string(solids_.size()));
        }
        if (options_.local_sizes()) {
            throw UnmeshableError(ErrorCode::bad_option, "blocks know one size, local ones are asked for");
        }
        BlockOptions own;
        own.execution = options_.execution;
        own.refine.emplace();
        own.refine->size = wishes_.size;
        const BlockedModel model = block_model(b_, solids_[0], own, kernels_.reference);
        if (model.shallow_creases) {
            result_.notes.emplace_back("edges of less than 45 degrees are features, too, since all faces are plane");
        }
        kernels_.describe(result_.report, b_, model);
        require_blocks(model.blocks);
        result_.notes.push_back(std::to_string(model.blocks.report.blocks.blocks) + " blocks");
        result_.data = block_mesh_data(model.blocks, model.reference.surface);
        result_.data.hex_groups.assign(result_.data.mesh.hexes.size(), b_.tag(3, solids_[0].index()));
        result_.data.groups = entity_groups(b_, solids_);
    }

    /// Raises the least scaled Jacobian where it is low, also by sliding nodes on plane faces.
    void improve() {
        constexpr double enough = 0.3;
        const double before = hex_quality(result_.data.mesh, {10, options_.execution}).scaled_jacobian.min;
        if (before >= enough || result_.data.quad_groups.size() != result_.data.quads.size()) {
            return;
        }
        ImproveOptions own;
        own.target = 0.5;
        own.sufficient = enough;
        own.effort = 30;
        own.execution = options_.execution;
        const PlaneGuide guide(b_, result_.data);
        HexMesh& mesh = result_.data.mesh;
        const SmoothReport report =
            improve_hexes(std::span(mesh.nodes), std::span<const HexCorners>(mesh.hexes), guide, own);
        kernels_.describe(result_.report, report);
        const double after = hex_quality(mesh, {10, options_.execution}).scaled_jacobian.min;
        if (after > before) {
            std::ostringstream note;
            note << "least scaled Jacobian raised from " << before << " by sliding nodes on plane faces";
            result_.notes.push_back(note.str());
        }
    }

    void judge() {
        const auto [check, volume] = judge_mesh(b_, solids_, options_.execution, result_);
        kernels_.describe(result_.report, result_.data, check, volume);
    }

private:
    [[nodiscard]] LocalSizes local_sizes() const {
        return {options_.edge_size, options_.face_size, options_.solid_size};
    }

    [[nodiscard]] std::vector<int> edge_tags(const EdgeChain& chain) const {
        std::vector<int> tags;
        for (const OrientedEdge& use : chain) {
            tags.push_back(b_.tag(1, use.edge.index()));
        }
        return tags;
    }

    const B& b_;
    std::span<const SolidId> solids_;
    const PartOptions& options_;
    K& kernels_;
    MethodTry& result_;
    IntervalOptions wishes_;
};

}  // namespace detail

/// What \p method makes of \p solids, which touch each other; errors of any kind end in the outcome, but for Stopped.
/// Local sizes by name must have been resolved. out_of_time() may be asked now and then.
template <brep B, class K, class OutOfTime>
[[nodiscard]] MethodTry try_method(PartMethod method, const B& b, std::span<const SolidId> solids,
                                   const PartOptions& options, K& kernels, OutOfTime&& out_of_time) {
    MethodTry result;
    result.method = method;
    const Stopwatch watch;
    detail::MethodTrier<B, K> trier(b, solids, options, kernels, result);
    try {
        switch (method) {
            case PartMethod::submap: trier.submap(); break;
            case PartMethod::sweep: trier.sweep(); break;
            case PartMethod::multi_sweep: trier.multi_sweep(out_of_time); break;
            case PartMethod::mixed: trier.mixed(out_of_time); break;
            case PartMethod::block: trier.block(); break;
        }
        if (!out_of_time()) {
            trier.improve();
        }
        trier.judge();
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
