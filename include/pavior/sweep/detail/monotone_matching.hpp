#pragma once
// Internals of ribs.hpp: curves sampled by arc length, and the monotone matching of two of them.

#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// f at position x of a table over [0, 1] with equal steps, linear between its entries.
template <class T>
[[nodiscard]] T at_table(std::span<const T> table, double x) {
    const double place = std::clamp(x, 0.0, 1.0) * static_cast<double>(table.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), table.size() - 2);
    const double t = place - static_cast<double>(i);
    return T((1.0 - t) * table[i] + t * table[i + 1]);
}

/// The x with table(x) = value, for an increasing table over [0, 1] from 0 to 1.
[[nodiscard]] inline double invert_table(std::span<const double> table, double value) {
    const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, value);
    const auto i = static_cast<std::size_t>(above - table.begin());
    const double step = table[i] - table[i - 1];
    const double t = step > 0.0 ? std::clamp((value - table[i - 1]) / step, 0.0, 1.0) : 0.5;
    return (static_cast<double>(i - 1) + t) / static_cast<double>(table.size() - 1);
}

/// A curve at equal steps of arc length: points, and the parameters there.
struct SampledRib {
    std::vector<Vec3> points;
    std::vector<double> parameters;
    std::function<Vec3(double)> curve;  ///< of the parameter

    /// On the polyline.
    [[nodiscard]] Vec3 point(double s) const { return at_table(std::span<const Vec3>(points), s); }
    /// On the curve itself.
    [[nodiscard]] Vec3 exact(double s) const { return curve(parameter(s)); }
    [[nodiscard]] double parameter(double s) const { return at_table(std::span<const double>(parameters), s); }
};

/// Points at equal steps of the length of the polyline \p points, whose parameters are \p parameters.
[[nodiscard]] inline SampledRib resample(std::span<const Vec3> points, std::span<const double> parameters,
                                         std::size_t steps, std::int64_t id) {
    std::vector<double> length(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        length[i] = length[i - 1] + (points[i] - points[i - 1]).norm();
    }
    if (!std::isfinite(length.back())) {
        throw InputError(ErrorCode::not_finite, "a rib has a point that is not finite", {id});
    }
    if (!(length.back() > 0.0)) {
        throw InputError(ErrorCode::empty_input, "a rib of length 0", {id});
    }
    SampledRib rib;
    std::size_t i = 1;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double wanted = length.back() * static_cast<double>(k) / static_cast<double>(steps);
        while (i + 1 < points.size() && length[i] < wanted) {
            ++i;
        }
        const double step = length[i] - length[i - 1];
        const double t = step > 0.0 ? std::clamp((wanted - length[i - 1]) / step, 0.0, 1.0) : 1.0;
        rib.points.push_back((1.0 - t) * points[i - 1] + t * points[i]);
        rib.parameters.push_back((1.0 - t) * parameters[i - 1] + t * parameters[i]);
    }
    rib.points.back() = points.back();
    rib.parameters.back() = parameters.back();
    return rib;
}

/// Monotone correspondence: pairs (i, j) from (0, 0) to (N, N), each step one ahead in one or both.
using MatchPath = std::vector<std::pair<std::size_t, std::size_t>>;

/// Dynamic programming: the path that minimises the integral of |a_i - b_j|^2 over both arc lengths. O(N^2) time and
/// bytes.
[[nodiscard]] inline MatchPath match_path(std::span<const Vec3> a, std::span<const Vec3> b) {
    const std::size_t n = a.size();
    const std::size_t m = b.size();
    enum : std::uint8_t { both, first, second };
    std::vector<std::uint8_t> from(n * m, both);
    std::vector<double> cost(m, 0.0);
    std::vector<double> before(m, 0.0);
    std::vector<double> square(m, 0.0);
    std::vector<double> square_before(m, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < m; ++j) {
            const double d = (a[i] - b[j]).squaredNorm();
            square[j] = d;
            double best = i == 0 && j == 0 ? 0.0 : std::numeric_limits<double>::infinity();
            std::uint8_t step = both;
            const auto offer = [&](double value, std::uint8_t way) {
                if (value < best) {
                    best = value;
                    step = way;
                }
            };
            if (i > 0 && j > 0) {
                offer(before[j - 1] + square_before[j - 1] + d, both);
            }
            if (i > 0) {
                offer(before[j] + 0.5 * (square_before[j] + d), first);
            }
            if (j > 0) {
                offer(cost[j - 1] + 0.5 * (square[j - 1] + d), second);
            }
            cost[j] = best;
            from[i * m + j] = step;
        }
        std::swap(cost, before);
        std::swap(square, square_before);
    }
    MatchPath path{{n - 1, m - 1}};
    while (path.back() != std::pair<std::size_t, std::size_t>{0, 0}) {
        auto [i, j] = path.back();
        const std::uint8_t step = from[i * m + j];
        path.emplace_back(step == second ? i : i - 1, step == first ? j : j - 1);
    }
    std::reverse(path.begin(), path.end());
    return path;
}

/// Moving mean over 2 h + 1 entries of an increasing table from 0 to 1, continued as an odd function about both ends:
/// the ends stay and it keeps increasing.
[[nodiscard]] inline std::vector<double> moving_mean(const std::vector<double>& table, std::size_t h) {
    const auto last = static_cast<std::ptrdiff_t>(table.size()) - 1;
    const auto value = [&](std::ptrdiff_t i) {
        if (i < 0) {
            return -table[static_cast<std::size_t>(-i)];
        }
        return i > last ? 2.0 - table[static_cast<std::size_t>(2 * last - i)] : table[static_cast<std::size_t>(i)];
    };
    const auto half = static_cast<std::ptrdiff_t>(std::min(h, table.size() - 1));
    std::vector<double> mean(table.size());
    double sum = 0.0;
    for (std::ptrdiff_t i = -half; i <= half; ++i) {
        sum += value(i);
    }
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        mean[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * half + 1);
        sum += value(i + half + 1 > 2 * last ? 2 * last : i + half + 1) - value(i - half);
    }
    mean.front() = 0.0;
    mean.back() = 1.0;
    return mean;
}

}  // namespace pavior::detail
