#pragma once
/// \file
/// The part of untangling that does not depend on what moves: which patches to free, in which order, what to keep.

#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/detail/patch.hpp>
#include <pavior/smooth/options.hpp>
#include <pavior/smooth/report.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pavior::detail {

/// A cell is inverted unless its smallest scaled determinant is above this.
inline constexpr double inverted_tolerance = 1e-12;

/// M moves nodes of cells of dimension D:
/// 1. m.quality(c) is the smallest scaled determinant of cell c as it is;
/// 2. m.hopeless(c) tells that cell c is inverted whatever the free nodes do;
/// 3. m.solve(patch, wanted) moves the free nodes of the patch until it is valid and its smallest determinant reaches
///    `wanted`, or does what it can, and returns the iterations done;
/// 4. m.save(patch) and m.restore(patch) keep and bring back, to the bit, the free nodes of one patch;
/// 5. (not checkable) quality and hopeless may be called from several threads if m.concurrent() is true.
template <class M, int D>
concept smoothing_model = requires(M& m, Index c, const Patch<D>& patch) {
    { m.quality(c) } -> std::convertible_to<double>;
    { m.hopeless(c) } -> std::convertible_to<bool>;
    { m.solve(patch, 1.0) } -> std::convertible_to<int>;
    m.save(patch);
    m.restore(patch);
    { m.concurrent() } -> std::convertible_to<bool>;
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

/// Repairs and optimises through a smoothing_model.
template <int D, smoothing_model<D> Model>
class Untangler {
public:
    Untangler(Model& model, std::span<const CellCorners<D>> cells, std::span<const std::uint8_t> fixed,
              const UntangleOptions& options)
        : model_(model),
          options_(options),
          cells_(cells),
          fixed_(fixed),
          quality_(cells.size()),
          moved_(fixed.size(), 0),
          seed_at_(cells.size(), 0) {}

    SmoothReport run() {
        scan();
        SmoothReport result;
        result.inverted_before = count_inverted();
        result.min_det_before = least();
        if (result.inverted_before != 0 || (options_.always && !cells_.empty())) {
            PatchFinder<D> finder(cells_, fixed_);
            repair(finder);
            if (options_.always) {
                optimise(finder);
            }
            scan();
        }
        result.iterations = iterations_;
        finish(result);
        return result;
    }

private:
    /// A cell on which work goes on: how few inverted cells an attempt round it has left so far, and how many attempts
    /// in a row brought nothing.
    struct Seed {
        Index cell;
        std::size_t fewest = static_cast<std::size_t>(-1);
        int idle = 0;
    };
    struct Score {
        std::size_t inverted = 0;
        double least = 1.0;
    };

    void scan() {
        const Execution execution = model_.concurrent() ? options_.execution : sequential;
        parallel_for(execution, cells_.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                quality_[c] = model_.quality(static_cast<Index>(c));
            }
        });
    }

    [[nodiscard]] bool inverted(Index c) const { return !(quality_[c] > inverted_tolerance); }
    [[nodiscard]] std::size_t count_inverted() const {
        std::size_t count = 0;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            count += inverted(static_cast<Index>(c)) ? 1U : 0U;
        }
        return count;
    }
    [[nodiscard]] double least() const {
        return quality_.empty() ? 1.0 : *std::min_element(quality_.begin(), quality_.end());
    }
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
        std::vector<Seed> seeds;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const Index id = static_cast<Index>(c);
            if (inverted(id) && !model_.hopeless(id)) {
                seeds.push_back({id});
            }
        }
        const double total = static_cast<double>(seeds.size());
        for (int rings = options_.local ? 1 : all_rings; !seeds.empty();
             rings = rings < all_rings ? 2 * rings : rings) {
            report(options_.progress, "untangle", 1.0 - static_cast<double>(seeds.size()) / total);
            seeds = repair_round(finder, seeds, rings);
        }
        report(options_.progress, "untangle", 1.0);
    }

    /// One attempt per patch round the seeds; the seeds that deserve another.
    std::vector<Seed> repair_round(PatchFinder<D>& finder, const std::vector<Seed>& seeds, int rings) {
        std::vector<Index> ids;
        for (std::size_t k = 0; k < seeds.size(); ++k) {
            ids.push_back(seeds[k].cell);
            seed_at_[seeds[k].cell] = static_cast<Index>(k);
        }
        std::vector<Seed> left;
        for (const Patch<D>& patch : finder.find(ids, rings)) {
            std::vector<Seed> here;
            for (const Index c : patch.cell_ids) {
                const Index k = seed_at_[c];
                if (k < seeds.size() && seeds[k].cell == c) {
                    here.push_back(seeds[k]);
                }
            }
            repair_patch(patch, here);
            left.insert(left.end(), here.begin(), here.end());
        }
        return left;
    }

    /// One attempt on a patch; \p seeds loses those that need no other or would not gain from it. What is not repaired
    /// goes back, so that the next attempt starts from the input; unless this is the last: then fewer count.
    void repair_patch(const Patch<D>& patch, std::vector<Seed>& seeds) {
        const Score before = score(patch);
        const Score after = try_patch(patch, options_.sufficient_det);
        const bool tangled = after.inverted > hopeless_in(patch);
        const bool better = after.inverted < before.inverted ||
                            (after.inverted == 0 && after.least > before.least + 0.1 * std::abs(before.least));
        bool last = patch.complete;
        for (Seed& seed : seeds) {
            const bool gained = tangled ? after.inverted < seed.fewest : better;
            seed.idle = gained ? 0 : seed.idle + 1;
            seed.fewest = std::min(seed.fewest, after.inverted);
            last = last || seed.idle >= (tangled && patch.cells.size() <= large_patch ? 4 : 2);
        }
        keep(patch, better && (!tangled || last));
        if (last || (!tangled && (after.inverted != 0 || after.least >= options_.sufficient_det))) {
            seeds.clear();
        }
    }

    /// Moves the nodes of a patch; what was is saved.
    Score try_patch(const Patch<D>& patch, double wanted) {
        model_.save(patch);
        iterations_ += model_.solve(patch, wanted);
        measure(patch);
        return score(patch);
    }

    void keep(const Patch<D>& patch, bool accepted) {
        if (accepted) {
            std::for_each_n(patch.nodes.begin(), patch.free_count, [&](Index i) { moved_[i] = 1; });
        } else {
            model_.restore(patch);
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
        report(options_.progress, "smooth", 0.0);
        for (const Patch<D>& patch : finder.find(all, 1)) {
            const Score before = score(patch);
            const Score after = try_patch(patch, 1.0);
            keep(patch, after.inverted < before.inverted ||
                            (after.inverted == before.inverted && after.least >= before.least));
        }
        report(options_.progress, "smooth", 1.0);
    }

    void finish(SmoothReport& result) const {
        result.inverted_after = count_inverted();
        result.min_det_after = least();
        result.moved_nodes = static_cast<std::size_t>(std::count(moved_.begin(), moved_.end(), std::uint8_t{1}));
        for (std::size_t c = 0; c < cells_.size() && result.inverted_ids.size() < options_.max_ids; ++c) {
            if (inverted(static_cast<Index>(c))) {
                result.inverted_ids.push_back(static_cast<Index>(c));
            }
        }
        result.status = result.inverted_after != 0    ? SmoothStatus::still_inverted
                        : result.inverted_before != 0 ? SmoothStatus::repaired
                        : result.moved_nodes != 0     ? SmoothStatus::improved
                                                      : SmoothStatus::unchanged;
    }

    static constexpr int all_rings = 1 << 30;
    static constexpr std::size_t large_patch = 2000;

    Model& model_;
    const UntangleOptions& options_;
    std::span<const CellCorners<D>> cells_;
    std::span<const std::uint8_t> fixed_;
    std::vector<double> quality_;
    std::vector<std::uint8_t> moved_;
    std::vector<Index> seed_at_;
    int iterations_ = 0;
};

}  // namespace pavior::detail
