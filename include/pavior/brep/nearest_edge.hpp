#pragma once
/// \file
/// The nearest of several edges of a CAD model to a point.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/edge_mesh.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// A point of an edge and how far it is from another.
struct EdgePoint {
    EdgeId edge;
    double t = 0;
    double distance = std::numeric_limits<double>::infinity();
};

namespace detail {

/// Points of an edge at equal steps of its parameter.
struct EdgeSamples {
    std::vector<Vec3> points;
    double slack = 0;  ///< how far the edge bulges between them, rather too much

    struct Foot {
        double at = 0;        ///< position among the points: 1.5 is in the middle of the second segment
        double distance = 0;  ///< from the segments
    };
    [[nodiscard]] Foot nearest(const Vec3& x) const;
    /// Doubles the samples with those in the middle of the segments, which set the slack.
    void refine(std::span<const Vec3> middles);
    /// Whether they follow an edge of the given length, or are very many.
    [[nodiscard]] bool fine(double length) const;
};

template <brep B>
[[nodiscard]] EdgeSamples edge_samples(const B& b, EdgeId e) {
    const std::array<double, 2> range = b.edge_range(e);
    const auto point = [&](std::size_t i, std::size_t n) {
        return b.edge_point(e, range[0] + (range[1] - range[0]) * static_cast<double>(i) / static_cast<double>(n));
    };
    EdgeSamples samples;
    for (std::size_t i = 0; i <= 8; ++i) {
        samples.points.push_back(point(i, 8));
    }
    do {
        std::vector<Vec3> middles;
        const std::size_t n = samples.points.size() - 1;
        for (std::size_t i = 0; i < n; ++i) {
            middles.push_back(point(2 * i + 1, 2 * n));
        }
        samples.refine(middles);
    } while (!samples.fine(b.edge_length(e)));
    return samples;
}

/// Where between \p low and \p high the distance from \p x stops falling, by halving.
template <brep B>
[[nodiscard]] double bisect_on_edge(const B& b, EdgeId e, const Vec3& x, double low, double high) {
    double middle = 0.5 * (low + high);
    for (int i = 0; i < 60 && low < middle && middle < high; ++i) {
        const bool falls = (x - b.edge_point(e, middle)).dot(b.edge_derivative(e, middle)) > 0;
        (falls ? low : high) = middle;
        middle = 0.5 * (low + high);
    }
    return middle;
}

}  // namespace detail

/// Closest points on edges, for many points: an edge is sampled when it is first asked for, and seldom evaluated again
/// for points that others are nearer to. A view of the model. Not thread-safe.
template <brep B>
class NearestEdge {
public:
    explicit NearestEdge(const B& b) : b_(b), samples_(b.edge_count()) {}

    /// The point of \p e next to \p x, to rounding, and within edge_range(): Gauss-Newton from the nearest segment
    /// between samples; by halving where that does not settle, which takes an x as far away as the edge is curved.
    /// About ten evaluations, then 120 more; and once 17 or more for the samples (until they follow the edge, at most
    /// 2000).
    [[nodiscard]] EdgePoint closest(EdgeId e, const Vec3& x) {
        const detail::EdgeSamples& s = samples(e);
        const std::array<double, 2> range = b_.edge_range(e);
        const double step = (range[1] - range[0]) / static_cast<double>(s.points.size() - 1);
        const double start = std::clamp(range[0] + step * s.nearest(x).at, range[0], range[1]);
        const double low = std::max(range[0], start - step);
        const double high = std::min(range[1], start + step);
        double t = detail::slide_on_edge(b_, e, x, start, low, high);
        const Vec3 d = b_.edge_derivative(e, t);
        const double move = std::clamp(t + (x - b_.edge_point(e, t)).dot(d) / d.squaredNorm(), low, high) - t;
        if (std::abs(move) > 1e-9 * step) {
            t = detail::bisect_on_edge(b_, e, x, low, high);
        }
        return {e, t, (b_.edge_point(e, t) - x).norm()};
    }

    /// The nearest of \p edges, of equally near ones the first found; no edge (invalid id) of none.
    [[nodiscard]] EdgePoint nearest(std::span<const EdgeId> edges, const Vec3& x) {
        if (edges.size() == 1) {
            return closest(edges[0], x);
        }
        std::vector<std::pair<double, EdgeId>> order;
        for (const EdgeId e : edges) {
            order.emplace_back(at_least(e, x), e);
        }
        std::sort(order.begin(), order.end());
        EdgePoint best;
        for (const auto& [bound, e] : order) {
            if (bound > best.distance) {
                break;
            }
            const EdgePoint found = closest(e, x);
            best = found.distance < best.distance ? found : best;
        }
        return best;
    }

    /// A lower bound of the distance of \p e from \p x, without evaluations once the edge is sampled; may be negative.
    [[nodiscard]] double at_least(EdgeId e, const Vec3& x) {
        const detail::EdgeSamples& s = samples(e);
        return s.nearest(x).distance - s.slack;
    }

private:
    [[nodiscard]] const detail::EdgeSamples& samples(EdgeId e) {
        detail::EdgeSamples& found = samples_[e.index()];
        if (found.points.empty()) {
            found = detail::edge_samples(b_, e);
        }
        return found;
    }

    const B& b_;
    std::vector<detail::EdgeSamples> samples_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/nearest_edge-inl.hpp>
#endif
