#include "snap.hpp"

#include <pavior/math/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <unordered_map>

namespace pavior::detail {

namespace {

using Segment = std::pair<Index, Index>;

/// Points in square bins.
class Bins {
public:
    explicit Bins(double width) : width_(width) {}

    void add(const Vec2& x, Index id) { bins_[key(bin(x[0]), bin(x[1]))].push_back(id); }

    /// Calls visit(id) for all points in bins that touch the box.
    template <class Visit>
    void visit(const Vec2& low, const Vec2& high, Visit&& visit) const {
        for (std::int64_t i = bin(low[0]); i <= bin(high[0]); ++i) {
            for (std::int64_t j = bin(low[1]); j <= bin(high[1]); ++j) {
                if (const auto found = bins_.find(key(i, j)); found != bins_.end()) {
                    for (const Index id : found->second) {
                        visit(id);
                    }
                }
            }
        }
    }

private:
    [[nodiscard]] std::int64_t bin(double x) const { return static_cast<std::int64_t>(std::floor(x / width_)); }
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15U ^ static_cast<std::uint64_t>(j);
    }

    double width_;
    std::unordered_map<std::uint64_t, std::vector<Index>> bins_;
};

/// Width of bins: never so small that a box holds more bins than there are points.
double bin_width(const std::vector<Vec2>& points, double tolerance) {
    const Vec2 extent = box_round(std::span<const Vec2>(points)).extent();
    return std::max(tolerance, extent.maxCoeff() / std::sqrt(static_cast<double>(points.size()) + 1));
}

/// The least tolerance of the routes through each point; infinite for a point that no route uses.
std::vector<double> point_tolerances(const Routes& routes) {
    std::vector<double> result(routes.points.size(), std::numeric_limits<double>::infinity());
    for (std::size_t r = 0; r < routes.routes.size(); ++r) {
        for (const Index i : routes.routes[r]) {
            result[i] = std::min(result[i], routes.tolerance[r]);
        }
    }
    return result;
}

/// The least tolerance of the routes along each segment.
std::vector<double> segment_tolerances(const Routes& routes, const std::vector<Segment>& segments) {
    std::vector<double> result(segments.size(), std::numeric_limits<double>::infinity());
    for (std::size_t r = 0; r < routes.routes.size(); ++r) {
        const std::vector<Index>& route = routes.routes[r];
        for (std::size_t i = 0; i + 1 < route.size(); ++i) {
            const Segment segment = std::minmax(route[i], route[i + 1]);
            const auto at = std::lower_bound(segments.begin(), segments.end(), segment) - segments.begin();
            double& least = result[static_cast<std::size_t>(at)];
            least = std::min(least, routes.tolerance[r]);
        }
    }
    return result;
}

double largest(const std::vector<double>& tolerances) {
    return *std::max_element(tolerances.begin(), tolerances.end());
}

}  // namespace

std::vector<Segment> Routes::segments() const {
    std::vector<Segment> result;
    for (const std::vector<Index>& route : routes) {
        for (std::size_t i = 0; i + 1 < route.size(); ++i) {
            result.push_back(std::minmax(route[i], route[i + 1]));
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

void Routes::refine(const std::vector<Segment>& segments, const std::vector<std::vector<Index>>& chains) {
    for (std::vector<Index>& route : routes) {
        std::vector<Index> fine(route.begin(), route.begin() + (route.empty() ? 0 : 1));
        for (std::size_t i = 0; i + 1 < route.size(); ++i) {
            const Segment segment = std::minmax(route[i], route[i + 1]);
            const auto at = std::lower_bound(segments.begin(), segments.end(), segment) - segments.begin();
            const std::vector<Index>& chain = chains[static_cast<std::size_t>(at)];
            if (segment.first == route[i]) {
                fine.insert(fine.end(), chain.begin() + 1, chain.end());
            } else {
                fine.insert(fine.end(), chain.rbegin() + 1, chain.rend());
            }
        }
        route = std::move(fine);
    }
}

void Routes::tidy() {
    for (std::vector<Index>& route : routes) {
        std::vector<Index> kept;
        for (const Index i : route) {
            if (!kept.empty() && kept.back() == i) {
                continue;
            }
            if (kept.size() > 1 && kept[kept.size() - 2] == i && corner[kept.back()] == 0) {
                kept.pop_back();
                continue;
            }
            kept.push_back(i);
        }
        route = std::move(kept);
    }
}

bool merge_points(Routes& routes) {
    const std::vector<double> tolerance = point_tolerances(routes);
    std::vector<Index> order;
    for (const char wanted : {char{1}, char{0}}) {
        for (Index i = 0; i < routes.points.size(); ++i) {
            if (routes.corner[i] == wanted && std::isfinite(tolerance[i])) {
                order.push_back(i);
            }
        }
    }
    Bins bins(bin_width(routes.points, largest(routes.tolerance)));
    std::vector<Index> image(routes.points.size());
    std::iota(image.begin(), image.end(), Index{0});
    bool changed = false;
    for (const Index i : order) {
        const Vec2 reach(tolerance[i], tolerance[i]);
        const Vec2& x = routes.points[i];
        Index nearest = i;
        double least = tolerance[i];
        bins.visit(x - reach, x + reach, [&](Index j) {
            const double distance = (routes.points[j] - x).norm();
            if (distance < tolerance[j] && (distance < least || (distance == least && j < nearest && nearest != i))) {
                least = distance;
                nearest = j;
            }
        });
        image[i] = nearest;
        if (nearest == i) {
            bins.add(x, i);
        }
    }
    for (std::vector<Index>& route : routes.routes) {
        for (Index& i : route) {
            changed = changed || image[i] != i;
            i = image[i];
        }
    }
    for (Index i = 0; i < image.size(); ++i) {
        if (image[i] != i && routes.corner[i] != 0) {
            routes.corner[image[i]] = 1;
        }
    }
    routes.tidy();
    return changed;
}

bool bend_segments(Routes& routes) {
    const std::vector<double> tolerance = point_tolerances(routes);
    Bins bins(bin_width(routes.points, largest(routes.tolerance)));
    for (Index i = 0; i < routes.points.size(); ++i) {
        if (std::isfinite(tolerance[i])) {
            bins.add(routes.points[i], i);
        }
    }
    const std::vector<Segment> segments = routes.segments();
    const std::vector<double> own = segment_tolerances(routes, segments);
    std::vector<std::vector<Index>> chains(segments.size());
    bool changed = false;
    for (std::size_t s = 0; s < segments.size(); ++s) {
        const Index a = segments[s].first;
        const Index b = segments[s].second;
        const Vec2 reach(own[s], own[s]);
        const Vec2 from = routes.points[a];
        const Vec2 along = routes.points[b] - from;
        std::vector<std::pair<double, Index>> near{{0.0, a}, {1.0, b}};
        bins.visit(from.cwiseMin(routes.points[b]) - reach, from.cwiseMax(routes.points[b]) + reach, [&](Index c) {
            const Vec2 x = routes.points[c] - from;
            const double t = x.dot(along) / along.squaredNorm();
            if (c != a && c != b && t > 0 && t < 1 && (x - t * along).norm() < std::min(own[s], tolerance[c])) {
                near.emplace_back(t, c);
            }
        });
        changed = changed || near.size() > 2;
        std::sort(near.begin(), near.end());
        for (const auto& [t, c] : near) {
            chains[s].push_back(c);
        }
    }
    routes.refine(segments, chains);
    routes.tidy();
    return changed;
}

}  // namespace pavior::detail
