#pragma once

#include <pavior/many_to_many/column_heights.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Eigen::Triplet<double>> coupling;
    for (const auto& edge : edges) {
        const double weight = 1 / std::max(1e-300, (plane[edge.first] - plane[edge.second]).norm());
        for (const auto& [i, j] : {edge, std::pair(edge.second, edge.first)}) {
            if (i < given) {
                continue;
            }
            const auto row = static_cast<int>(i - given);
            entries.emplace_back(row, row, weight);
            if (j >= given) {
                entries.emplace_back(row, static_cast<int>(j - given), -weight);
            } else {
                coupling.emplace_back(row, static_cast<int>(j), weight);
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(inner_), static_cast<Eigen::Index>(inner_));
    matrix.setFromTriplets(entries.begin(), entries.end());
    coupling_.resize(static_cast<Eigen::Index>(inner_), static_cast<Eigen::Index>(given));
    coupling_.setFromTriplets(coupling.begin(), coupling.end());
    solver_.compute(matrix);
}

PAVIOR_INLINE Eigen::MatrixX2d InnerLaplace::solve(const Eigen::MatrixX2d& given) const {
    if (inner_ == 0) {
        return Eigen::MatrixX2d(0, 2);
    }
    return solver_.solve(coupling_ * given);
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
