#pragma once
/// \file
/// Raises the worst cells of a mesh first, never below what they were.

#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/smooth/detail/patch.hpp>
#include <pavior/smooth/detail/patch_schedule.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/lbfgs.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// When WorstFirst ends and what it counts as progress.
struct WorstFirstOptions {
    double target = 1.0;      ///< cells that reach this are left alone
    double sufficient = 0.3;  ///< cells below this are worked on even when a worse one is stuck
    double gain = 0.01;       ///< an attempt that raises a cell by less is idle
    int rings = 2;            ///< of the largest patch; a cell is stuck after one idle attempt with each
    int attempts = 30;        ///< on one cell at most; on a cell that is inverted 2 * rings
    double effort = 1000.0;   ///< cells of patches times evaluations, divided by cells of the mesh (1000 at least)
    Execution execution = sequential;
    Progress progress = {};
};

/// Works in rounds on the cells next above the worst: frees the nodes within one ring of them (two after an idle
/// attempt, and so on) and lets the model raise each patch. A patch is kept if its sorted qualities grow in
/// lexicographic order; nodes round cells that would fall to the worst of its seeds or get inverted go back.
/// Model: a smoothing_model of hexahedra with raise(patch, wanted, execution) and bound(c), which the quality of cell c
/// cannot exceed.
template <class Model>
class WorstFirst {
public:
    WorstFirst(Model& model, std::size_t cells, PatchFinder<3>& finder, WorstFirstOptions options)
        : model_(model), options_(std::move(options)), finder_(finder), states_(cells) {}

    /// \return iterations of the minimiser. Ends when every cell that can be better is within `gain` of the target, or
    /// the worst of them is stuck and those that are not reach `sufficient`, or the effort is spent.
    int run() {
        quality_ = scan_quality(model_, states_.size(), options_.execution);
        for (std::size_t c = 0; c < quality_.size(); ++c) {
            states_[c].wanted = std::min(options_.target, model_.bound(static_cast<Index>(c))) - options_.gain;
        }
        const double allowed = options_.effort * static_cast<double>(std::max<std::size_t>(1000, states_.size()));
        report(options_.progress, "improve", 0.0);
        double done = 0.0;  // the worst that is not stuck may become worse: a stuck one has another try
        for (std::vector<Index> seeds = next_seeds(); !seeds.empty() && work_ < allowed; seeds = next_seeds()) {
            done = std::max(done, std::min(1.0, quality_[seeds.front()] / options_.target));
            report(options_.progress, "improve", done);
            for (int idle = 0; !seeds.empty(); ++idle) {
                std::vector<Index> same;
                std::copy_if(seeds.begin(), seeds.end(), std::back_inserter(same),
                             [&](Index c) { return states_[c].idle == idle; });
                raise(same, idle + 1);
                std::erase_if(seeds, [&](Index c) { return states_[c].idle <= idle || stuck(c); });
            }
        }
        report(options_.progress, "improve", 1.0);
        return iterations_;
    }

    /// Of each cell, as it is now.
    [[nodiscard]] std::span<const double> quality() const { return quality_; }

private:
    struct State {
        double wanted = 0.0;  ///< a cell below this should be better
        int idle = 0;
        int attempts = 0;
        bool seed = false;
    };

    [[nodiscard]] bool stuck(Index c) const {
        const int attempts =
            is_inverted(quality_[c]) ? std::min(2 * options_.rings, options_.attempts) : options_.attempts;
        return states_[c].idle >= options_.rings || states_[c].attempts >= attempts;
    }

    /// The cells to work on, the worst first; none: the end.
    [[nodiscard]] std::vector<Index> next_seeds() const {
        double worst = 1.0;
        double worst_stuck = 1.0;
        for (std::size_t c = 0; c < quality_.size(); ++c) {
            if (quality_[c] < states_[c].wanted) {
                double& least = stuck(static_cast<Index>(c)) ? worst_stuck : worst;
                least = std::min(least, quality_[c]);
            }
        }
        std::vector<Index> seeds;
        if (worst >= options_.sufficient && worst_stuck <= worst) {
            return seeds;
        }
        const double band = worst + 0.1;
        for (std::size_t c = 0; c < quality_.size(); ++c) {
            if (quality_[c] < std::min(band, states_[c].wanted) && !stuck(static_cast<Index>(c))) {
                seeds.push_back(static_cast<Index>(c));
            }
        }
        std::stable_sort(seeds.begin(), seeds.end(), [&](Index a, Index b) { return quality_[a] < quality_[b]; });
        return seeds;
    }

    void raise(const std::vector<Index>& seeds, int rings) {
        for (const Index c : seeds) {
            states_[c].seed = true;
            ++states_[c].attempts;
        }
        const std::vector<Patch<3>> patches = finder_.find(seeds, rings);
        std::vector<LbfgsResult> done(patches.size());
        const auto concurrent = [&](const Patch<3>& patch) { return model_.concurrent(patch); };
        for_each_patch(options_.execution, patches, concurrent,
                       [&](std::size_t k, const Execution& execution) { done[k] = attempt(patches[k], execution); });
        for (const Index c : seeds) {
            states_[c].idle = states_[c].seed ? states_[c].idle + 1 : states_[c].idle;
            states_[c].seed = false;
        }
        for (std::size_t k = 0; k < patches.size(); ++k) {
            iterations_ += done[k].iterations;
            work_ += static_cast<double>(done[k].evaluations) * static_cast<double>(patches[k].cells.size());
        }
    }

    /// Raises one patch; the seeds that gained are none any more.
    LbfgsResult attempt(const Patch<3>& patch, const Execution& execution) {
        std::vector<double> before(patch.cell_ids.size());
        double worst = 1.0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            const Index c = patch.cell_ids[k];
            before[k] = quality_[c];
            worst = states_[c].seed ? std::min(worst, before[k]) : worst;
        }
        const auto saved = model_.save(patch);
        const LbfgsResult done = model_.raise(patch, options_.target, execution);
        measure(patch);
        roll_back(patch, saved, before, worst);
        if (!better(patch, before)) {
            model_.restore(patch, saved);
            for (std::size_t k = 0; k < before.size(); ++k) {
                quality_[patch.cell_ids[k]] = before[k];
            }
            return done;
        }
        for (std::size_t k = 0; k < before.size(); ++k) {
            const Index c = patch.cell_ids[k];
            if (quality_[c] >= before[k] + options_.gain || !states_[c].seed) {
                states_[c].seed = false;
                states_[c].idle = 0;
            }
        }
        return done;
    }

    void measure(const Patch<3>& patch) {
        for (const Index c : patch.cell_ids) {
            quality_[c] = model_.quality(c);
        }
    }

    /// Puts nodes back until every cell that is worse than before is above the worst of the seeds and not newly
    /// inverted.
    template <class Saved>
    void roll_back(const Patch<3>& patch, const Saved& saved, const std::vector<double>& before, double worst) {
        std::vector<std::uint8_t> back(patch.free_count, 0);
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t k = 0; k < before.size(); ++k) {
                const double now = quality_[patch.cell_ids[k]];
                if (now >= before[k] || (now > worst && (!is_inverted(now) || is_inverted(before[k])))) {
                    continue;
                }
                for (const Index i : patch.cells[k]) {
                    if (i < patch.free_count && back[i] == 0) {
                        back[i] = 1;
                        changed = true;
                        model_.restore(patch, saved, i);
                    }
                }
            }
            if (changed) {
                measure(patch);
            }
        }
    }

    [[nodiscard]] bool better(const Patch<3>& patch, std::vector<double> before) const {
        std::vector<double> after(before.size());
        std::transform(patch.cell_ids.begin(), patch.cell_ids.end(), after.begin(),
                       [&](Index c) { return quality_[c]; });
        std::sort(before.begin(), before.end());
        std::sort(after.begin(), after.end());
        return std::lexicographical_compare(before.begin(), before.end(), after.begin(), after.end());
    }

    Model& model_;
    WorstFirstOptions options_;
    PatchFinder<3>& finder_;
    std::vector<double> quality_;
    std::vector<State> states_;
    int iterations_ = 0;
    double work_ = 0.0;
};

}  // namespace pavior::detail
