#pragma once
/// \file
/// One operator per level that takes both caps to the level: steps 5, 6 and 10 of Algorithm 4.1 \cite roca2009.

#include <pavior/affine/fit.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/sweep/node_kernel.hpp>
#include <pavior/sweep/problem.hpp>

#include <cstddef>
#include <cstdint>
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

}  // namespace detail

/// The maps of levels 1 .. r - 1, in that order; empty for r = 1. With `direct` the map of a level depends on the two
/// caps and that level alone. With `front` the maps of a march are composed, which gives the nodes of the march itself
/// up to rounding, with and without boundary correction: the residuals of the composed map are what the march carries
/// along. O(m r); the bits do not depend on \p options.execution.
/// \throws InputError with the level in ids(): null_pseudo_area, source_degenerate, target_degenerate, unrelated_loops,
/// not_finite (a loop that the method cannot map); bad_option, size_mismatch (blending)
[[nodiscard]] PAVIOR_INLINE std::vector<LevelMap> make_level_maps(const SweepProblem& problem,
                                                                  const LevelMapOptions& options = {});

/// Both maps and their weights in one operator on caps whose coordinates are taken from \p source_centre and
/// \p target_centre; equation (4.8) \cite roca2009.
[[nodiscard]] PAVIOR_INLINE LevelOperator fold(const LevelMap& map, const Vec3& source_centre,
                                               const Vec3& target_centre);

namespace detail {

[[nodiscard]] PAVIOR_INLINE AffineFit<double, 3> fit_levels(const SweepProblem& problem, std::size_t from,
                                                            std::size_t to, const LevelMapOptions& options);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/level_map-inl.hpp>
#endif
