#pragma once
/// \file
/// Node positions on the ribs of a sweep (the curves from the source to the target) that follow each other.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>
#include <pavior/sweep/detail/monotone_matching.hpp>
#include <pavior/sweep/spacing.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

/// C is a rib_curve if, for a const C& c, c(t) is convertible to Vec3 for every t in [0, 1]: a continuous curve from
/// the source cap (t = 0) to the target cap (t = 1), any regular parametrisation (not checkable).
/// Models: Polyline, a lambda, std::function<Vec3(double)>.
template <class C>
concept rib_curve = requires(const C& c, double t) {
    { c(t) } -> std::convertible_to<Vec3>;
};

/// A polyline of two or more points as a rib_curve, t proportional to arc length. Copies the points.
class Polyline {
public:
    explicit Polyline(std::vector<Vec3> points);
    [[nodiscard]] Vec3 operator()(double t) const {
        const double wanted = t * length_.back();
        const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
        const auto i = static_cast<std::size_t>(above - length_.begin());
        const double step = length_[i] - length_[i - 1];
        const double u = step > 0.0 ? std::clamp((wanted - length_[i - 1]) / step, 0.0, 1.0) : 0.0;
        return (1.0 - u) * points_[i - 1] + u * points_[i];
    }

private:
    std::vector<Vec3> points_;
    std::vector<double> length_;
};

struct RibOptions {
    /// Equal spacing is kept if the sine of every corner of the ruled patches is above this, or if following is not
    /// better; in [0, 1). 0: if no quad folds.
    double sufficient_det = 0.1;
    /// Each interval keeps at least this part of its equal-spacing length, in [0, 1); less where quads fold otherwise.
    double min_spacing = 0.1;
    /// Steps of the sampling, at least 64; 0: eight a level, between 256 and 2048.
    std::size_t samples = 0;
};

/// Level positions on p ribs and their report. A quad is one of the ruled patch between two neighbouring ribs; it is
/// folded if a corner is inverted as seen from the normal (tangent x direction to the matching point of the other rib).
struct RibPositions {
    std::vector<std::vector<double>> parameters;  ///< [rib][level], increasing from 0 to 1
    bool equal_spacing = true;                    ///< equal arc lengths (or those of the Spacing) are kept on each rib
    std::size_t folded_equal = 0;                 ///< quads that equal spacing folds
    std::size_t folded = 0;                       ///< quads folded by the positions returned
    double min_det_equal = 1.0;                   ///< smallest corner sine with equal spacing, 1 without patches
    double min_det = 1.0;                         ///< smallest corner sine of the positions returned
};

namespace detail {

/// Neighbouring ribs.
using RibPairs = std::vector<std::array<std::size_t, 2>>;

/// The positions on sampled ribs: equal spacing if that is fine, the matched ones if they are better.
[[nodiscard]] PAVIOR_INLINE RibPositions place_on_ribs(std::span<const SampledRib> ribs, const RibPairs& pairs,
                                                       const Spacing& spacing, const RibOptions& options);

/// The result refers to \p curve.
template <rib_curve C>
[[nodiscard]] SampledRib sample_rib(const C& curve, std::size_t steps, std::int64_t id) {
    const std::size_t fine = 4 * steps;
    std::vector<Vec3> points;
    std::vector<double> parameters;
    for (std::size_t i = 0; i <= fine; ++i) {
        parameters.push_back(static_cast<double>(i) / static_cast<double>(fine));
        points.push_back(curve(parameters.back()));
    }
    SampledRib rib = resample(points, parameters, steps, id);
    rib.curve = [&curve](double t) -> Vec3 { return curve(t); };
    return rib;
}

[[nodiscard]] PAVIOR_INLINE std::size_t rib_samples(const RibOptions& options, std::size_t intervals);

}  // namespace detail

/// Level positions on two opposite curves, section 4.2.3 \cite roca2009: "nodes follow those of the opposite edge".
/// Both get the positions of \p spacing by arc length (equal spacing) if no quad of the ruled patch between them folds
/// or nearly folds then (RibOptions::sufficient_det). Otherwise they are matched monotonically so that the squared
/// distance between opposite nodes, integrated over
/// both curves, is least (dynamic programming on a fine sampling), the match is smoothed over about one interval, and
/// \p spacing is applied to the mean of the two arc lengths. Swapping the curves swaps the result.
/// InputError: empty_input (a curve of length 0), not_finite, bad_option. A fold that remains is reported.
/// O(samples^2) time and bytes; as thread-safe as the curves.
template <rib_curve A, rib_curve B>
[[nodiscard]] RibPositions opposite_positions(const A& a, const B& b, const Spacing& spacing,
                                              const RibOptions& options = {}) {
    const std::size_t steps = detail::rib_samples(options, spacing.intervals());
    const std::array<detail::SampledRib, 2> ribs{detail::sample_rib(a, steps, 0), detail::sample_rib(b, steps, 1)};
    return detail::place_on_ribs(ribs, {{0, 1}}, spacing, options);
}

/// The same for all ribs of a sweep. The ribs of loop l are ribs[loop_offsets[l]] .. ribs[loop_offsets[l + 1] - 1] in
/// cyclic order; neighbours bound a linking side. If equal spacing folds or nearly folds a quad of any ruled patch,
/// every rib is
/// matched against the mean curve of all ribs, so that levels are nearly perpendicular to it.
/// InputError: as opposite_positions() (ids: ribs), bad_index (offsets). O(p samples^2).
template <rib_curve C>
[[nodiscard]] RibPositions rib_positions(std::span<const C> ribs, std::span<const std::size_t> loop_offsets,
                                         const Spacing& spacing, const RibOptions& options = {}) {
    if (loop_offsets.size() < 2 || loop_offsets.front() != 0 || loop_offsets.back() != ribs.size() || ribs.empty() ||
        !std::is_sorted(loop_offsets.begin(), loop_offsets.end())) {
        throw InputError(ErrorCode::bad_index, "loop offsets do not run from 0 to the number of ribs");
    }
    const std::size_t steps = detail::rib_samples(options, spacing.intervals());
    std::vector<detail::SampledRib> sampled;
    for (const C& rib : ribs) {
        sampled.push_back(detail::sample_rib(rib, steps, static_cast<std::int64_t>(sampled.size())));
    }
    detail::RibPairs pairs;
    for (std::size_t l = 0; l + 1 < loop_offsets.size(); ++l) {
        const std::size_t first = loop_offsets[l];
        const std::size_t count = loop_offsets[l + 1] - first;
        for (std::size_t i = 0; i + (count == 2 ? 1 : 0) < count && count > 1; ++i) {
            pairs.push_back({first + i, first + (i + 1) % count});
        }
    }
    return detail::place_on_ribs(sampled, pairs, spacing, options);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/ribs-inl.hpp>
#endif
