#pragma once
// Polylines as routes over shared points, and the snapping that keeps points and segments apart. Internal to imprint.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Curves as sequences of points; neighbours in a route differ.
struct Routes {
    std::vector<Vec2> points;
    std::vector<std::vector<Index>> routes;
    std::vector<char> corner;       ///< per point: an end of a curve
    std::vector<double> tolerance;  ///< per route

    /// The unordered pairs of neighbours, each once, ascending.
    [[nodiscard]] std::vector<std::pair<Index, Index>> segments() const;
    /// Replaces each step a, b of a route by the chain of its segment (in the order min to max).
    void refine(const std::vector<std::pair<Index, Index>>& segments, const std::vector<std::vector<Index>>& chains);
    /// Removes repetitions and spikes a, b, a.
    void tidy();
};

/// Merges points closer than the smaller of their tolerances (each the least of its routes): corners first, then by
/// number, each joins the nearest that stays. True if any did.
bool merge_points(Routes& routes);

/// Leads segments through the points that they pass closer than the smaller of their tolerances. True if any did.
bool bend_segments(Routes& routes);

}  // namespace pavior::detail
