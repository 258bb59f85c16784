#pragma once
/// \file
/// Nodes along the edges of a CAD model, equally spaced in arc length or at given fractions of it.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

/// Table of the arc length of an edge against its parameter, on equal parameter steps.
struct ArcLength {
    double first = 0, step = 0;
    std::vector<double> length;  ///< from the first parameter to first + i * step

    /// Parameter at which the length from the start is \p s: linear in each step of the table.
    [[nodiscard]] double parameter(double s) const;
};

/// Speed |d/dt| integrated by Simpson's rule on \p steps steps.
template <brep B>
[[nodiscard]] ArcLength arc_length(const B& b, EdgeId e, std::size_t steps) {
    const std::array<double, 2> range = b.edge_range(e);
    ArcLength table{range[0], (range[1] - range[0]) / static_cast<double>(steps), std::vector<double>(steps + 1, 0.0)};
    double left = b.edge_derivative(e, range[0]).norm();
    for (std::size_t i = 0; i < steps; ++i) {
        const double t = table.first + table.step * static_cast<double>(i);
        const double middle = b.edge_derivative(e, t + 0.5 * table.step).norm();
        const double right = b.edge_derivative(e, i + 1 == steps ? range[1] : t + table.step).norm();
        table.length[i + 1] = table.length[i] + table.step * (left + 4 * middle + right) / 6;
        left = right;
    }
    return table;
}

/// Gauss-Newton from \p t towards the point of \p e next to \p x, within [low, high].
template <brep B>
[[nodiscard]] double slide_on_edge(const B& b, EdgeId e, const Vec3& x, double t, double low, double high) {
    const std::array<double, 2> range = b.edge_range(e);
    for (int i = 0; i < 20; ++i) {
        const Vec3 d = b.edge_derivative(e, t);
        const double move = d.squaredNorm() > 0 ? (x - b.edge_point(e, t)).dot(d) / d.squaredNorm() : 0.0;
        const double next = std::clamp(t + move, low, high);
        const bool done = std::abs(next - t) <= 1e-15 * (range[1] - range[0]);
        t = next;
        if (done) {
            break;
        }
    }
    return t;
}

}  // namespace detail

/// Parameters of \p e at the given fractions (0 .. 1, ascending) of its arc length. Exact for edges of constant speed
/// (lines, circles); otherwise to about 1e-4 of the edge's length. The ends of the range are met exactly.
/// Costs 512 evaluations of the derivative, 17 where the speed is constant.
template <brep B>
[[nodiscard]] std::vector<double> edge_parameters(const B& b, EdgeId e, std::span<const double> fractions) {
    const std::array<double, 2> range = b.edge_range(e);
    detail::ArcLength table = detail::arc_length(b, e, 8);
    double deviation = 0;
    for (std::size_t i = 0; i <= 8; ++i) {
        deviation = std::max(deviation, std::abs(table.length[i] - table.length[8] * static_cast<double>(i) / 8));
    }
    const bool constant_speed = deviation <= 1e-9 * table.length[8];
    if (!constant_speed) {
        table = detail::arc_length(b, e, 256);
    }
    std::vector<double> parameters;
    parameters.reserve(fractions.size());
    for (const double fraction : fractions) {
        const double t = constant_speed ? range[0] + fraction * (range[1] - range[0])
                                        : table.parameter(fraction * table.length.back());
        parameters.push_back(fraction <= 0 ? range[0] : fraction >= 1 ? range[1] : t);
    }
    return parameters;
}

/// Parameter of a point of \p e next to \p x: Gauss-Newton from the nearest of 33 samples, so to rounding where x lies
/// on the edge. Never outside the range. About 40 evaluations.
template <brep B>
[[nodiscard]] double closest_on_edge(const B& b, EdgeId e, const Vec3& x) {
    constexpr int samples = 32;
    const std::array<double, 2> range = b.edge_range(e);
    const double step = (range[1] - range[0]) / samples;
    double best = range[0];
    double least = (b.edge_point(e, best) - x).squaredNorm();
    for (int i = 1; i <= samples; ++i) {
        const double t = i == samples ? range[1] : range[0] + i * step;
        const double distance = (b.edge_point(e, t) - x).squaredNorm();
        if (distance < least) {
            least = distance;
            best = t;
        }
    }
    return detail::slide_on_edge(b, e, x, best, std::max(range[0], best - step), std::min(range[1], best + step));
}

/// 0, 1/n, 2/n, ..., 1.
[[nodiscard]] PAVIOR_INLINE std::vector<double> equal_fractions(int intervals);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/edge_mesh-inl.hpp>
#endif
