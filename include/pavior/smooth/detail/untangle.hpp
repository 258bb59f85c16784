#pragma once
/// \file
/// The part of untangling that does not depend on what moves: which patches to free, in which order, what to keep.

#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/detail/patch.hpp>
#include <pavior/smooth/detail/patch_schedule.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace pavior::detail {

/// A cell is inverted unless its smallest scaled determinant is above this.
inline constexpr double inverted_tolerance = 1e-12;

[[nodiscard]] inline bool is_inverted(double quality) { return !(quality > inverted_tolerance); }

/// The quality of each cell of a smoothing_model.
template <class Model>
[[nodiscard]] std::vector<double> scan_quality(const Model& model, std::size_t cells, const Execution& execution) {
    std::vector<double> quality(cells);
    const Execution allowed{model.concurrent() ? execution.threads : 1, execution.stop};
    parallel_for(allowed, cells, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            quality[c] = model.quality(static_cast<Index>(c));
        }
    });
    return quality;
}

/// What a report says of the cells before any work.
inline void set_before(SmoothReport& result, std::span<const double> quality) {
    result.inverted_before = static_cast<std::size_t>(std::count_if(quality.begin(), quality.end(), is_inverted));
    result.min_det_before = quality.empty() ? 1.0 : *std::min_element(quality.begin(), quality.end());
}

/// What a report says of them afterwards, and the status; moved_nodes must be known.
inline void set_after(SmoothReport& result, std::span<const double> quality, std::size_t max_ids) {
    SmoothReport now;
    set_before(now, quality);
    result.inverted_after = now.inverted_before;
    result.min_det_after = now.min_det_before;
    for (std::size_t c = 0; c < quality.size() && result.inverted_ids.size() < max_ids; ++c) {
        if (is_inverted(quality[c])) {
            result.inverted_ids.push_back(static_cast<Index>(c));
        }
    }
    result.status = result.inverted_after != 0    ? SmoothStatus::still_inverted
                    : result.inverted_before != 0 ? SmoothStatus::repaired
                    : result.moved_nodes != 0     ? SmoothStatus::improved
                                                  : SmoothStatus::unchanged;
}

/// M moves nodes of cells of dimension D:
/// 1. m.quality(c) is the smallest scaled determinant of cell c as it is;
/// 2. m.hopeless(c) tells that cell c cannot be repaired, whatever the free nodes do;
/// 3. m.solve(patch, wanted, execution) moves the free nodes of the patch until it is valid and its smallest
///    determinant reaches `wanted`, or does what it can, and returns the iterations done;
/// 4. m.save(patch) and m.restore(patch, saved) keep and bring back, to the bit, the free nodes of one patch;
/// 5. (not checkable) quality and hopeless may be called from several threads if m.concurrent() is true, and solve for
///    patches that share no cell if m.concurrent(patch) is true for each of them.
template <class M, int D>
concept smoothing_model = requires(M& m, Index c, const Patch<D>& patch) {
    { m.quality(c) } -> std::convertible_to<double>;
    { m.hopeless(c) } -> std::convertible_to<bool>;
    { m.solve(patch, 1.0, sequential) } -> std::convertible_to<int>;
    m.restore(patch, m.save(patch));
    { m.concurrent() } -> std::convertible_to<bool>;
    { m.concurrent(patch) } -> std::convertible_to<bool>;
};

template <int D>
void check_cells(std::span<const CellCorners<D>> cells, std::size_t node_count, std::size_t fixed_count) {
    if (fixed_count != node_count) {
        throw InputError(ErrorCode::size_mismatch, "one fixed flag per node is needed: " + std::to_string(node_count) +
                                                       " nodes, " + std::to_string(fixed_count) + " flags");
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
        CellCorners<D> sorted = cells[c];
        std::sort(sorted.begin(), sorted.end());
        if (sorted.back() >= node_count || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
            throw InputError(ErrorCode::bad_index,
                             "cell " + std::to_string(c) + " names a node out of range or one node twice",
                             {static_cast<std::int64_t>(c)});
        }
    }
}

template <class Point>
void check_finite(std::span<const Point> nodes, const char* what) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].allFinite()) {
            throw InputError(ErrorCode::not_finite, std::string(what) + " " + std::to_string(i) + " is not finite",
                             {static_cast<std::int64_t>(i)});
        }
    }
}

/// work(); if that throws, what it may have written goes back.
template <class T, class Work>
auto done_or_undone(std::span<T> written, const Work& work) {
    const std::vector<T> before(written.begin(), written.end());
    try {
        return work();
    } catch (...) {
        std::copy(before.begin(), before.end(), written.begin());
        throw;
    }
}

/// Repairs and optimises through a smoothing_model.
template <int D, smoothing_model<D> Model>
class Untangler {
public:
    Untangler(Model& model, std::span<const CellCorners<D>> cells, std::span<const std::uint8_t> fixed,
              const UntangleOptions& options)
        : model_(model),
          options_(options),
          repair_progress_(options.always ? stage_of(options.progress, 0.0, 0.5) : options.progress),
          smooth_progress_(stage_of(options.progress, 0.5, 1.0)),
          cells_(cells),
          fixed_(fixed),
          quality_(cells.size()),
          moved_(fixed.size(), 0),
          seed_at_(cells.size(), 0) {}

    SmoothReport run() {
        scan();
        SmoothReport result;
        set_before(result, quality_);
        if (result.inverted_before != 0 || (options_.always && !cells_.empty())) {
            PatchFinder<D> finder(cells_, fixed_);
            repair(finder);
            if (options_.always) {
                optimise(finder);
            }
            scan();
        }
        result.iterations = iterations_;
        result.moved_nodes = static_cast<std::size_t>(std::count(moved_.begin(), moved_.end(), std::uint8_t{1}));
        set_after(result, quality_, options_.max_ids);
        return result;
    }

private:
    /// A cell on which work goes on: how few inverted cells an attempt round it has left so far, and how many attempts
    /// in a row brought nothing.
    struct Seed {
        Index cell;
        std::size_t fewest = static_cast<std::size_t>(-1) / 4;
        int idle = 0;
    };
    struct Score {
        std::size_t inverted = 0;
        double least = 1.0;
    };

    void scan() { quality_ = scan_quality(model_, cells_.size(), options_.execution); }
    [[nodiscard]] bool inverted(Index c) const { return is_inverted(quality_[c]); }
    [[nodiscard]] Score score(const Patch<D>& patch) const {
        Score result;
        for (const Index c : patch.cell_ids) {
            result.inverted += inverted(c) ? 1U : 0U;
            result.least = std::min(result.least, quality_[c]);
        }
        return result;
    }
    void measure(const Patch<D>& patch) {
        for (const Index c : patch.cell_ids) {
            quality_[c] = model_.quality(c);
        }
    }

    void repair(PatchFinder<D>& finder) {
        std::vector<Index> ids;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (inverted(static_cast<Index>(c))) {
                ids.push_back(static_cast<Index>(c));
            }
        }
        if constexpr (requires { model_.find_hopeless(ids, finder); }) {
            model_.find_hopeless(ids, finder);
        }
        std::vector<Seed> seeds;
        for (const Index c : ids) {
            if (!model_.hopeless(c)) {
                seeds.push_back({c});
            }
        }
        const double total = static_cast<double>(seeds.size());
        for (int rings = options_.local ? 1 : all_rings; !seeds.empty();
             rings = rings < all_rings ? 2 * rings : rings) {
            report(repair_progress_, "untangle", 1.0 - static_cast<double>(seeds.size()) / total);
            seeds = repair_round(finder, seeds, rings);
        }
        report(repair_progress_, "untangle", 1.0);
    }

    /// One attempt per patch round the seeds; the seeds that deserve another.
    std::vector<Seed> repair_round(PatchFinder<D>& finder, const std::vector<Seed>& seeds, int rings) {
        std::vector<Index> ids;
        for (std::size_t k = 0; k < seeds.size(); ++k) {
            ids.push_back(seeds[k].cell);
            seed_at_[seeds[k].cell] = static_cast<Index>(k);
        }
        const std::vector<Patch<D>> patches = finder.find(ids, rings);
        std::vector<std::vector<Seed>> left(patches.size());
        std::vector<int> iterations(patches.size());
        const auto concurrent = [&](const Patch<D>& patch) { return model_.concurrent(patch); };
        for_each_patch(options_.execution, patches, concurrent, [&](std::size_t at, const Execution& execution) {
            for (const Index c : patches[at].cell_ids) {
                const Index k = seed_at_[c];
                if (k < seeds.size() && seeds[k].cell == c) {
                    left[at].push_back(seeds[k]);
                }
            }
            iterations[at] = repair_patch(patches[at], left[at], execution);
        });
        iterations_ = std::accumulate(iterations.begin(), iterations.end(), iterations_);
        std::vector<Seed> all;
        for (const std::vector<Seed>& part : left) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }

    /// One attempt on a patch; \p seeds loses those that need no other or would not gain from it. What is not repaired
    /// goes back, so that the next attempt starts from the input; unless this is the last: then fewer count.
    /// \return iterations done.
    int repair_patch(const Patch<D>& patch, std::vector<Seed>& seeds, const Execution& execution) {
        const Score before = score(patch);
        const auto saved = model_.save(patch);
        const int iterations = model_.solve(patch, options_.sufficient_det, execution);
        measure(patch);
        const Score after = score(patch);
        const bool tangled = after.inverted > hopeless_in(patch);
        const bool lower = options_.keep_minimum && after.least < before.least;
        const bool better = (after.inverted < before.inverted && !lower) ||
                            (after.inverted == 0 && after.least > before.least + 0.1 * std::abs(before.least));
        bool last = patch.complete;
        for (Seed& seed : seeds) {
            const bool gained = tangled ? 4 * after.inverted < 3 * seed.fewest : better;
            seed.idle = gained ? 0 : seed.idle + 1;
            seed.fewest = std::min(seed.fewest, after.inverted);
            last = last || seed.idle >= (tangled && patch.cells.size() <= large_patch ? 4 : 2);
        }
        keep(patch, better && (!tangled || last), saved);
        if (last || (!tangled && (after.inverted != 0 || after.least >= options_.sufficient_det))) {
            seeds.clear();
        }
        return iterations;
    }

    template <class Saved>
    void keep(const Patch<D>& patch, bool accepted, const Saved& saved) {
        if (accepted) {
            std::for_each_n(patch.nodes.begin(), patch.free_count, [&](Index i) { moved_[i] = 1; });
        } else {
            model_.restore(patch, saved);
            measure(patch);
        }
    }

    [[nodiscard]] std::size_t hopeless_in(const Patch<D>& patch) const {
        return static_cast<std::size_t>(std::count_if(patch.cell_ids.begin(), patch.cell_ids.end(),
                                                      [&](Index c) { return inverted(c) && model_.hopeless(c); }));
    }

    void optimise(PatchFinder<D>& finder) {
        std::vector<Index> all(cells_.size());
        for (std::size_t c = 0; c < all.size(); ++c) {
            all[c] = static_cast<Index>(c);
        }
        report(smooth_progress_, "smooth", 0.0);
        for (const Patch<D>& patch : finder.find(all, 1)) {
            const Score before = score(patch);
            const auto saved = model_.save(patch);
            iterations_ += model_.solve(patch, 1.0, options_.execution);
            measure(patch);
            const Score after = score(patch);
            const bool better =
                after.inverted < before.inverted || (after.inverted == before.inverted && after.least >= before.least);
            keep(patch, better, saved);
        }
        report(smooth_progress_, "smooth", 1.0);
    }

    static constexpr std::size_t large_patch = 2000;  ///< cells; a larger one gets fewer attempts
    static constexpr int all_rings = 1 << 30;

    Model& model_;
    const UntangleOptions& options_;
    Progress repair_progress_;
    Progress smooth_progress_;
    std::span<const CellCorners<D>> cells_;
    std::span<const std::uint8_t> fixed_;
    std::vector<double> quality_;
    std::vector<std::uint8_t> moved_;
    std::vector<Index> seed_at_;
    int iterations_ = 0;
};

}  // namespace pavior::detail
