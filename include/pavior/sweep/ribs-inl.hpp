#pragma once

#include <pavior/sweep/ribs.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE Polyline::Polyline(std::vector<Vec3> points) : points_(std::move(points)), length_(points_.size(), 0.0) {
    if (points_.size() < 2) {
        throw InputError(ErrorCode::empty_input, "a polyline needs at least two points");
    }
    for (std::size_t i = 1; i < points_.size(); ++i) {
        length_[i] = length_[i - 1] + (points_[i] - points_[i - 1]).norm();
    }
}

namespace detail {

/// Monotone correspondence of p ribs: table[j][k] is the arc-length fraction of rib j at step k of the common path.
using RibTables = std::vector<std::vector<double>>;

/// Arc-length fractions (of either side) along a match, tabulated at equal steps of their mean.
[[nodiscard]] inline std::array<std::vector<double>, 2> tabulate(const MatchPath& path, std::size_t steps) {
    std::array<std::vector<double>, 2> tables{std::vector<double>(steps + 1), std::vector<double>(steps + 1)};
    std::size_t at = 1;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double wanted = 2.0 * static_cast<double>(k);
        while (at + 1 < path.size() && static_cast<double>(path[at].first + path[at].second) < wanted) {
            ++at;
        }
        const auto low = static_cast<double>(path[at - 1].first + path[at - 1].second);
        const auto high = static_cast<double>(path[at].first + path[at].second);
        const double t = std::clamp((wanted - low) / (high - low), 0.0, 1.0);
        const auto mix = [t, steps](std::size_t a, std::size_t b) {
            return ((1.0 - t) * static_cast<double>(a) + t * static_cast<double>(b)) / static_cast<double>(steps);
        };
        tables[0][k] = mix(path[at - 1].first, path[at].first);
        tables[1][k] = mix(path[at - 1].second, path[at].second);
    }
    return tables;
}

/// Two ribs matched with each other; swapping them swaps the tables exactly.
[[nodiscard]] inline RibTables match_pair(const SampledRib& a, const SampledRib& b) {
    const std::size_t steps = a.points.size() - 1;
    const auto there = tabulate(match_path(a.points, b.points), steps);
    const auto back = tabulate(match_path(b.points, a.points), steps);
    RibTables tables(2, std::vector<double>(steps + 1));
    for (std::size_t k = 0; k <= steps; ++k) {
        tables[0][k] = 0.5 * (there[0][k] + back[1][k]);
        tables[1][k] = 0.5 * (there[1][k] + back[0][k]);
    }
    return tables;
}

/// The mean of the ribs at corresponding places, resampled by arc length.
[[nodiscard]] inline SampledRib mean_rib(std::span<const SampledRib> ribs, const RibTables& tables) {
    const std::size_t steps = ribs.front().points.size() - 1;
    std::vector<Vec3> mean(steps + 1, Vec3::Zero());
    std::vector<double> parameters(steps + 1);
    for (std::size_t k = 0; k <= steps; ++k) {
        parameters[k] = static_cast<double>(k) / static_cast<double>(steps);
        for (std::size_t j = 0; j < ribs.size(); ++j) {
            mean[k] += ribs[j].point(tables[j][k]) / static_cast<double>(ribs.size());
        }
    }
    return resample(mean, parameters, steps, -1);
}

/// Arc-length fraction of \p rib at equal steps of the arc length of \p centre.
[[nodiscard]] inline std::vector<double> match_to(const SampledRib& centre, const SampledRib& rib) {
    const auto tables = tabulate(match_path(centre.points, rib.points), centre.points.size() - 1);
    const std::size_t steps = centre.points.size() - 1;
    std::vector<double> table(steps + 1);
    for (std::size_t k = 0; k <= steps; ++k) {
        const double w = invert_table(tables[0], static_cast<double>(k) / static_cast<double>(steps));
        table[k] = at_table(std::span<const double>(tables[1]), w);
    }
    table.front() = 0.0;
    table.back() = 1.0;
    return table;
}

/// Matches p ribs with their mean, which is then made again from the matching points, a few times.
[[nodiscard]] inline RibTables match_all(std::span<const SampledRib> ribs) {
    if (ribs.size() == 2) {
        return match_pair(ribs[0], ribs[1]);
    }
    const std::size_t steps = ribs.front().points.size() - 1;
    RibTables tables(ribs.size(), std::vector<double>(steps + 1));
    for (std::vector<double>& table : tables) {
        for (std::size_t k = 0; k <= steps; ++k) {
            table[k] = static_cast<double>(k) / static_cast<double>(steps);
        }
    }
    constexpr int rounds = 5;
    for (int round = 0; ribs.size() > 1 && round < rounds; ++round) {
        const SampledRib centre = mean_rib(ribs, tables);
        for (std::size_t j = 0; j < ribs.size(); ++j) {
            tables[j] = match_to(centre, ribs[j]);
        }
    }
    return tables;
}

/// How the ruled patches fare with given positions.
struct RuledQuality {
    std::size_t folded = 0;
    double min_det = 1.0;
};

/// Arc-length fractions [rib][level].
using RibLevels = std::vector<std::vector<double>>;

class RuledPatches {
public:
    RuledPatches(std::span<const SampledRib> ribs, const RibTables& tables, const RibPairs& pairs)
        : ribs_(ribs), tables_(tables), pairs_(pairs) {}

    [[nodiscard]] RuledQuality quality(const RibLevels& levels) const {
        RuledQuality result;
        for (const auto& [a, b] : pairs_) {
            for (std::size_t k = 0; k + 1 < levels[a].size(); ++k) {
                const double det = std::min(side_det(a, b, levels, k), side_det(b, a, levels, k));
                result.folded += det > 1e-12 ? 0 : 1;
                result.min_det = std::min(result.min_det, det);
            }
        }
        return result;
    }

private:
    /// The normal of the patch in the middle of interval k of rib a, towards the matching point of rib b.
    [[nodiscard]] Vec3 normal(std::size_t a, std::size_t b, const RibLevels& levels, std::size_t k) const {
        const double w = 0.5 * (invert_table(tables_[a], levels[a][k]) + invert_table(tables_[a], levels[a][k + 1]));
        const double s = at_table(std::span<const double>(tables_[a]), w);
        const double step = 1.0 / static_cast<double>(ribs_[a].points.size() - 1);
        const Vec3 tangent = ribs_[a].point(s + step) - ribs_[a].point(s - step);
        const Vec3 across = ribs_[b].point(at_table(std::span<const double>(tables_[b]), w)) - ribs_[a].point(s);
        return tangent.cross(across).normalized();
    }

    /// Smallest sine of the two corners of quad k on rib a.
    [[nodiscard]] double side_det(std::size_t a, std::size_t b, const RibLevels& levels, std::size_t k) const {
        const Vec3 n = normal(a, b, levels, k);
        const std::array<Vec3, 2> on_a{ribs_[a].exact(levels[a][k]), ribs_[a].exact(levels[a][k + 1])};
        const Vec3 along = on_a[1] - on_a[0];
        double det = 1.0;
        for (std::size_t end = 0; end < 2; ++end) {
            const Vec3 across = ribs_[b].exact(levels[b][k + end]) - on_a[end];
            const double lengths = along.norm() * across.norm();
            // Where the ribs meet there is no corner to look at.
            if (lengths > 0.0 && n != Vec3::Zero()) {
                det = std::min(det, along.cross(across).dot(n) / lengths);
            }
        }
        return det;
    }

    std::span<const SampledRib> ribs_;
    const RibTables& tables_;
    const RibPairs& pairs_;
};

/// Widens the intervals of one rib that are shorter than \p least times those of \p spacing to that length, at the cost
/// of what the others have above it.
inline void widen_intervals(std::vector<double>& levels, const Spacing& spacing, double least) {
    double excess = 0.0;
    for (std::size_t k = 0; k < spacing.intervals(); ++k) {
        excess += std::max(0.0, levels[k + 1] - levels[k] - least * (spacing[k + 1] - spacing[k]));
    }
    double before = 0.0;
    double at = 0.0;
    for (std::size_t k = 0; k < spacing.intervals(); ++k) {
        const double floor = least * (spacing[k + 1] - spacing[k]);
        at += floor + std::max(0.0, levels[k + 1] - before - floor) * (1.0 - least) / excess;
        before = std::exchange(levels[k + 1], at);
    }
    levels.back() = 1.0;
}

/// Levels at the positions of \p spacing on smoothed tables, no interval shorter than \p least times its own.
[[nodiscard]] inline RibLevels place_levels(const RibTables& tables, const Spacing& spacing, double least) {
    RibLevels levels(tables.size());
    const std::size_t h = (tables.front().size() - 1) / (2 * spacing.intervals());
    for (std::size_t j = 0; j < tables.size(); ++j) {
        const std::vector<double> smooth = moving_mean(moving_mean(tables[j], h), h);
        for (const double w : spacing.positions()) {
            levels[j].push_back(at_table(std::span<const double>(smooth), w));
        }
        widen_intervals(levels[j], spacing, least);
    }
    return levels;
}

[[nodiscard]] inline bool strictly_increasing(const RibLevels& levels) {
    return std::all_of(levels.begin(), levels.end(), [](const std::vector<double>& rib) {
        return std::adjacent_find(rib.begin(), rib.end(), [](double a, double b) { return !(a < b); }) == rib.end();
    });
}

PAVIOR_INLINE RibPositions place_on_ribs(std::span<const SampledRib> ribs, const RibPairs& pairs,
                                         const Spacing& spacing, const RibOptions& options) {
    const RibTables tables = match_all(ribs);
    const RuledPatches patches(ribs, tables, pairs);
    const std::vector<double> wanted(spacing.positions().begin(), spacing.positions().end());
    RibLevels best(ribs.size(), wanted);
    RuledQuality quality = patches.quality(best);
    RibPositions result;
    result.folded_equal = quality.folded;
    result.min_det_equal = quality.min_det;
    if (quality.folded != 0 || !(quality.min_det > options.sufficient_det)) {
        for (const double share : {1.0, 0.3, 0.1, 0.0}) {
            RibLevels levels = place_levels(tables, spacing, share * options.min_spacing);
            const RuledQuality now = patches.quality(levels);
            const bool better =
                now.folded < quality.folded || (now.folded == quality.folded && now.min_det > quality.min_det);
            if (better && strictly_increasing(levels)) {
                best = std::move(levels);
                quality = now;
                result.equal_spacing = false;
                if (now.folded == 0) {
                    break;
                }
            }
        }
    }
    result.folded = quality.folded;
    result.min_det = quality.min_det;
    for (std::size_t j = 0; j < ribs.size(); ++j) {
        result.parameters.emplace_back();
        for (const double s : best[j]) {
            result.parameters.back().push_back(ribs[j].parameter(s));
        }
    }
    return result;
}

PAVIOR_INLINE std::size_t rib_samples(const RibOptions& options, std::size_t intervals) {
    const bool bad = !(options.sufficient_det >= 0.0 && options.sufficient_det < 1.0) ||
                     !(options.min_spacing >= 0.0 && options.min_spacing < 1.0) ||
                     (options.samples != 0 && options.samples < 64);
    if (bad) {
        throw InputError(ErrorCode::bad_option, "an option of the ribs is out of its range");
    }
    return options.samples != 0 ? options.samples : std::clamp<std::size_t>(8 * intervals, 256, 2048);
}

}  // namespace detail

}  // namespace pavior
