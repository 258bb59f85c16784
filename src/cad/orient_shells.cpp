#include "orient_shells.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pavior::detail {

namespace {

struct Use {
    std::array<Index, 2> nodes{};  ///< ascending
    std::size_t triangle = 0;
    bool forward = true;  ///< the triangle runs from the smaller node to the larger
};

std::vector<Use> edges_of(std::span<const TriCorners> triangles) {
    std::vector<Use> uses;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangles[t][k];
            const Index b = triangles[t][(k + 1) % 3];
            uses.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
    });
    return uses;
}

double volume_part(std::span<const Vec3> nodes, const TriCorners& c, const Vec3& origin) {
    return (nodes[c[0]] - origin).cross(nodes[c[1]] - origin).dot(nodes[c[2]] - origin);
}

/// A neighbour across an edge, and whether it sees the other side.
struct Neighbour {
    std::size_t triangle = 0;
    bool turned = false;
};

}  // namespace

std::vector<std::size_t> orient_shells(std::span<const Vec3> nodes, std::span<TriCorners> triangles) {
    std::vector<std::vector<Neighbour>> neighbours(triangles.size());
    std::vector<std::size_t> open;
    const std::vector<Use> uses = edges_of(triangles);
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i + 1;
        while (end < uses.size() && uses[end].nodes == uses[i].nodes) {
            ++end;
        }
        if (end - i == 2) {
            const bool turned = uses[i].forward == uses[i + 1].forward;
            neighbours[uses[i].triangle].push_back({uses[i + 1].triangle, turned});
            neighbours[uses[i + 1].triangle].push_back({uses[i].triangle, turned});
        } else {
            for (std::size_t k = i; k < end; ++k) {
                open.push_back(uses[k].triangle);
            }
        }
        i = end;
    }
    if (!open.empty() || triangles.empty()) {
        return open;
    }
    std::vector<int> sense(triangles.size(), 0);
    std::vector<std::vector<std::size_t>> shells;
    std::vector<double> volumes;
    for (std::size_t first = 0; first < triangles.size(); ++first) {
        if (sense[first] != 0) {
            continue;
        }
        std::vector<std::size_t> shell{first};
        sense[first] = 1;
        double volume = 0.0;
        for (std::size_t i = 0; i < shell.size(); ++i) {
            const std::size_t t = shell[i];
            volume += sense[t] * volume_part(nodes, triangles[t], nodes[triangles[0][0]]);
            for (const Neighbour& next : neighbours[t]) {
                if (sense[next.triangle] == 0) {
                    sense[next.triangle] = next.turned ? -sense[t] : sense[t];
                    shell.push_back(next.triangle);
                }
            }
        }
        shells.push_back(std::move(shell));
        volumes.push_back(volume);
    }
    const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto outer =
        static_cast<std::size_t>(std::max_element(volumes.begin(), volumes.end(), larger) - volumes.begin());
    for (std::size_t s = 0; s < shells.size(); ++s) {
        const int wanted = (volumes[s] > 0.0) == (s == outer) ? 1 : -1;
        for (const std::size_t t : shells[s]) {
            if (sense[t] != wanted) {
                std::swap(triangles[t][1], triangles[t][2]);
            }
        }
    }
    return {};
}

}  // namespace pavior::detail
