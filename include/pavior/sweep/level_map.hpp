#pragma once
/// \file
/// One operator per level that takes both caps to the level: steps 5, 6 and 10 of Algorithm 4.1 \cite roca2009.

#include <pavior/affine/fit.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/sweep/node_kernel.hpp>
#include <pavior/sweep/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// How a level is reached from the caps.
enum class SweepStrategy : std::uint8_t {
    direct,  ///< by one map from each cap: no level depends on another
    front,   ///< by the maps from level to level, in two independent marches from the source and from the target
};

/// "direct" or "front".
[[nodiscard]] constexpr std::string_view to_string(SweepStrategy strategy) noexcept {
    return strategy == SweepStrategy::direct ? "direct" : "front";
}

/// The maps of one inner level k, 0 < k < r.
struct LevelMap {
    AffineMap<double, 3> from_source;  ///< takes level 0 to level k; a composition with `front`
    AffineMap<double, 3> from_target;  ///< takes level r to level k
    double blending = 0;               ///< t_k: weight of the target side; 1 - t_k is that of the source side
    double residual_max = 0;           ///< largest |x_k - map(x)| over the loop, worse side; user's unit
    double residual_rms = 0;           ///< root mean square of the same, worse side
    bool ambiguous_normal = false;     ///< method h: a direction was perpendicular to its pseudo-normal
    bool exact = false;                ///< both residuals are rounding noise: there is nothing to correct
};

/// What make_level_maps() needs besides the problem.
struct LevelMapOptions {
    AffineMethod method = AffineMethod::constrained;
    SweepStrategy strategy = SweepStrategy::direct;
    /// t_0 .. t_r, weights of the target side: t_0 = 0, t_r = 1, not decreasing. Empty: k / r, equation (4.8).
    std::vector<double> blending{};
    FitOptions fit{};
    Execution execution{};
};

namespace detail {

using LoopPoints = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;

[[nodiscard]] inline LoopPoints loop_points(const SweepProblem& problem, std::size_t k) {
    return {problem.level(k).data()->data(), 3, static_cast<Eigen::Index>(problem.loops.nodes.size())};
}

[[nodiscard]] inline AffineFit<double, 3> fit_levels(const SweepProblem& problem, std::size_t from, std::size_t to,
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

/// The maps of levels 1 .. r - 1, in that order; empty for r = 1. With `direct` the map of a level depends on the two
/// caps and that level alone. With `front` the maps of a march are composed, which gives the nodes of the march itself
/// up to rounding, with and without boundary correction: the residuals of the composed map are what the march carries
/// along. O(m r); the bits do not depend on \p options.execution.
/// \throws InputError with the level in ids(): null_pseudo_area, source_degenerate, target_degenerate, unrelated_loops,
/// not_finite (a loop that the method cannot map); bad_option, size_mismatch (blending)
[[nodiscard]] inline std::vector<LevelMap> make_level_maps(const SweepProblem& problem,
                                                           const LevelMapOptions& options = {}) {
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

/// Both maps and their weights in one operator on caps whose coordinates are taken from \p source_centre and
/// \p target_centre; equation (4.8) \cite roca2009.
[[nodiscard]] inline LevelOperator fold(const LevelMap& map, const Vec3& source_centre, const Vec3& target_centre) {
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
