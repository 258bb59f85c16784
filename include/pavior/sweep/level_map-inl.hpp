#pragma once

#include <pavior/core/parallel_for.hpp>
#include <pavior/sweep/level_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE AffineFit<double, 3> fit_levels(const SweepProblem& problem, std::size_t from, std::size_t to,
                                              const LevelMapOptions& options) {
    auto fit = fit_affine(options.method, loop_points(problem, from), loop_points(problem, to), problem.loops.offsets,
                          options.fit);
    if (fit.status != FitStatus::ok) {
        const std::size_t culprit = fit.at_target ? to : from;
        throw InputError(to_error_code(fit.status),
                         "no affine map from level " + std::to_string(from) + " to level " + std::to_string(to) + " (" +
                             std::string(to_string(fit.status)) + " at level " + std::to_string(culprit) + ")",
                         {static_cast<std::int64_t>(culprit)});
    }
    return fit;
}

inline void check_blending(const std::vector<double>& blending, std::size_t layers) {
    if (blending.empty()) {
        return;
    }
    if (blending.size() != layers + 1) {
        throw InputError(ErrorCode::size_mismatch, "blending has " + std::to_string(blending.size()) + " values, " +
                                                       std::to_string(layers + 1) + " levels need one each");
    }
    // Negated so that NaN is refused.
    if (!(blending.front() == 0.0 && blending.back() == 1.0)) {
        throw InputError(ErrorCode::bad_option, "blending must run from 0 to 1");
    }
    for (std::size_t k = 1; k <= layers; ++k) {
        if (!(blending[k] >= blending[k - 1])) {
            throw InputError(ErrorCode::bad_option, "blending decreases at level " + std::to_string(k),
                             {static_cast<std::int64_t>(k)});
        }
    }
}

/// Sets the residuals of \p map at level \p k.
inline void measure_residuals(const SweepProblem& problem, std::size_t k, LevelMap& map) {
    const auto sides = {std::pair{&map.from_source, std::size_t{0}}, std::pair{&map.from_target, problem.layers}};
    map.exact = true;
    for (const auto& [side, cap] : sides) {
        double largest = 0;
        double extent = 0;
        for (std::size_t i = 0; i < problem.loops.nodes.size(); ++i) {
            const Vec3& x = problem.level(k)[i];
            const Vec3& from = problem.level(cap)[i];
            largest = std::max(largest, (x - (*side)(from)).cwiseAbs().maxCoeff());
            extent = std::max({extent, x.cwiseAbs().maxCoeff(), from.cwiseAbs().maxCoeff()});
        }
        map.exact = map.exact && largest <= 32 * std::numeric_limits<double>::epsilon() * extent;
        double sum = 0;
        double longest = 0;
        for (std::size_t i = 0; i < problem.loops.nodes.size() && largest > 0; ++i) {
            const double square = ((problem.level(k)[i] - (*side)(problem.level(cap)[i])) / largest).squaredNorm();
            sum += square;
            longest = std::max(longest, square);
        }
        const double m = static_cast<double>(problem.loops.nodes.size());
        map.residual_max = std::max(map.residual_max, largest * std::sqrt(longest));
        map.residual_rms = std::max(map.residual_rms, largest * std::sqrt(sum / m));
    }
}

/// Fits of all inner levels: maps[k - 1].from_source is (before k -> k) and from_target (after k -> k).
[[nodiscard]] inline std::vector<LevelMap> fit_all(const SweepProblem& problem, const LevelMapOptions& options) {
    const std::size_t r = problem.layers;
    const bool front = options.strategy == SweepStrategy::front;
    std::vector<LevelMap> maps(r - 1);
    parallel_for(options.execution, r - 1, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin + 1; k <= end; ++k) {
            LevelMap& map = maps[k - 1];
            const auto source = fit_levels(problem, front ? k - 1 : 0, k, options);
            const auto target = fit_levels(problem, front ? k + 1 : r, k, options);
            map.from_source = source.map;
            map.from_target = target.map;
            map.ambiguous_normal = source.ambiguous_normal || target.ambiguous_normal;
            map.blending =
                options.blending.empty() ? static_cast<double>(k) / static_cast<double>(r) : options.blending[k];
        }
    });
    return maps;
}

}  // namespace detail

PAVIOR_INLINE std::vector<LevelMap> make_level_maps(const SweepProblem& problem, const LevelMapOptions& options) {
    detail::check_blending(options.blending, problem.layers);
    if (problem.layers < 2) {
        return {};
    }
    std::vector<LevelMap> maps = detail::fit_all(problem, options);
    if (options.strategy == SweepStrategy::front) {
        for (std::size_t i = 1; i < maps.size(); ++i) {
            const std::size_t j = maps.size() - 1 - i;
            maps[i].from_source = compose(maps[i].from_source, maps[i - 1].from_source);
            maps[j].from_target = compose(maps[j].from_target, maps[j + 1].from_target);
        }
    }
    parallel_for(options.execution, maps.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            detail::measure_residuals(problem, i + 1, maps[i]);
        }
    });
    return maps;
}

PAVIOR_INLINE LevelOperator fold(const LevelMap& map, const Vec3& source_centre, const Vec3& target_centre) {
    LevelOperator level;
    const double s = 1.0 - map.blending;
    const double t = map.blending;
    const Vec3 centre = s * map.from_source(source_centre) + t * map.from_target(target_centre);
    for (std::size_t c = 0; c < 3; ++c) {
        const auto row = static_cast<Eigen::Index>(c);
        level.centre[c] = centre[row];
        for (std::size_t j = 0; j < 3; ++j) {
            level.linear[j][c] = s * map.from_source.A(row, static_cast<Eigen::Index>(j));
            level.linear[j + 3][c] = t * map.from_target.A(row, static_cast<Eigen::Index>(j));
        }
    }
    return level;
}

}  // namespace pavior
