#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/many_to_many/column_heights.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::size_t ColumnNodes::number() {
    Index next = 0;
    for (Index& id : id_) {
        if (id != no_index) {
            id = next++;
        }
    }
    return next;
}

namespace detail {

PAVIOR_INLINE void extend_heights(std::span<const Vec2> plane, std::span<const QuadCorners> quads, double tolerance,
                                  const std::function<std::optional<double>(Index p)>& known,
                                  const std::function<void(Index p, double height)>& extend) {
    std::vector<Index> local(plane.size(), no_index);
    std::vector<Index> nodes;
    std::vector<std::pair<Index, Index>> edges;
    for (const QuadCorners& quad : quads) {
        for (const Index p : quad) {
            if (local[p] == no_index) {
                local[p] = static_cast<Index>(nodes.size());
                nodes.push_back(p);
            }
        }
        for (std::size_t k = 0; k < 4; ++k) {
            edges.push_back(std::minmax(local[quad[k]], local[quad[(k + 1) % 4]]));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    DisjointSets parts(nodes.size());
    for (const auto& [a, b] : edges) {
        parts.unite(a, b);
    }
    constexpr std::int64_t unreached = std::numeric_limits<std::int64_t>::max();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> height(nodes.size(), infinity);
    std::vector<double> low(nodes.size(), infinity);
    std::vector<double> high(nodes.size(), -infinity);
    for (Index i = 0; i < nodes.size(); ++i) {
        if (const auto at = known(nodes[i])) {
            height[i] = *at;
            low[parts.root(i)] = std::min(low[parts.root(i)], *at);
            high[parts.root(i)] = std::max(high[parts.root(i)], *at);
        }
    }
    std::vector<std::int64_t> number(nodes.size(), unreached);
    std::int64_t unknowns = 0, given = 0;
    std::vector<double> given_height;
    for (Index i = 0; i < nodes.size(); ++i) {
        const Index r = parts.root(i);
        if (height[i] != infinity) {
            number[i] = -1 - given++;
            given_height.push_back(height[i]);
        } else if (low[r] <= high[r]) {
            if (high[r] - low[r] <= tolerance) {
                extend(nodes[i], 0.5 * (low[r] + high[r]));
            } else {
                number[i] = unknowns++;
            }
        }
    }
    if (unknowns == 0) {
        return;
    }
    std::vector<GraphLaplacian::Edge> weighted;
    for (const auto& [a, b] : edges) {
        if (number[a] != unreached && number[b] != unreached) {
            weighted.push_back(
                {number[a], number[b], 1 / std::max(1e-300, (plane[nodes[a]] - plane[nodes[b]]).norm())});
        }
    }
    const Eigen::VectorXd solution =
        GraphLaplacian(unknowns, given, weighted).solve(Eigen::Map<const Eigen::VectorXd>(given_height.data(), given));
    for (Index i = 0; i < nodes.size(); ++i) {
        if (number[i] >= 0 && number[i] != unreached) {
            extend(nodes[i], solution[number[i]]);
        }
    }
}

PAVIOR_INLINE InnerLaplace::InnerLaplace(std::span<const Vec2> plane, std::span<const QuadCorners> quads,
                                         std::size_t given)
    : inner_(plane.size() - given) {
    std::vector<std::pair<Index, Index>> edges;
    for (const QuadCorners& quad : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            edges.push_back(std::minmax(quad[k], quad[(k + 1) % 4]));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    const auto number = [&](Index i) {
        return i < given ? -1 - static_cast<std::int64_t>(i) : static_cast<std::int64_t>(i - given);
    };
    std::vector<GraphLaplacian::Edge> weighted;
    for (const auto& [a, b] : edges) {
        weighted.push_back({number(a), number(b), 1 / std::max(1e-300, (plane[a] - plane[b]).norm())});
    }
    laplacian_ = GraphLaplacian(static_cast<std::int64_t>(inner_), static_cast<std::int64_t>(given), weighted);
}

PAVIOR_INLINE Eigen::MatrixX2d InnerLaplace::solve(const Eigen::MatrixX2d& given) const {
    Eigen::MatrixX2d result(static_cast<Eigen::Index>(inner_), 2);
    for (const Eigen::Index c : {0, 1}) {
        result.col(c) = laplacian_.solve(given.col(c));
    }
    return result;
}

PAVIOR_INLINE void fill_column(Index plane_node, std::size_t first, std::size_t last, const ColumnNodes& nodes,
                               std::span<Vec3> places, std::span<NodePlace> how) {
    constexpr double share = 0.1;
    const auto id = [&](std::size_t level) { return nodes(plane_node, level); };
    const auto given = [&](std::size_t level) { return how[id(level)] >= NodePlace::cap; };
    const auto interpolate = [&](std::size_t a, std::size_t b) {
        for (std::size_t level = a + 1; level < b; ++level) {
            const double t = static_cast<double>(level - a) / static_cast<double>(b - a);
            places[id(level)] = (1 - t) * places[id(a)] + t * places[id(b)];
        }
    };
    std::size_t low = first;
    for (std::size_t next = first + 1; next <= last; ++next) {
        if (!given(next)) {
            continue;
        }
        const Vec3& bottom = places[id(low)];
        const Vec3& top = places[id(next)];
        const double step = share * (top[2] - bottom[2]) / static_cast<double>(next - low);
        std::size_t at = low;
        for (std::size_t level = low + 1; level < next; ++level) {
            if (how[id(level)] != NodePlace::extended) {
                continue;
            }
            const double height = places[id(level)][2];
            if (height - places[id(at)][2] < step * static_cast<double>(level - at) ||
                top[2] - height < step * static_cast<double>(next - level)) {
                continue;
            }
            interpolate(at, level);
            at = level;
        }
        interpolate(at, next);
        low = next;
    }
}

}  // namespace detail

}  // namespace pavior
