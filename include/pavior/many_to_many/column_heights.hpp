#pragma once
/// \file
/// Places of nodes in columns: those on caps, curves and vertices are given; levels run on smoothly from there through
/// the solid, and layers between levels are of equal height.

#include <pavior/core/compiled.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Ids of nodes (plane node, level), level by level.
class ColumnNodes {
public:
    ColumnNodes(std::size_t plane_nodes, std::size_t levels)
        : width_(plane_nodes), id_(plane_nodes * levels, no_index) {}

    /// Marks a node as needed.
    void use(Index plane_node, std::size_t level) { id_[level * width_ + plane_node] = 0; }
    /// Numbers the nodes in use and returns how many there are.
    std::size_t number();
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t levels() const { return width_ == 0 ? 0 : id_.size() / width_; }
    /// The id, no_index where there is no node.
    [[nodiscard]] Index operator()(Index plane_node, std::size_t level) const {
        return id_[level * width_ + plane_node];
    }

private:
    std::size_t width_;
    std::vector<Index> id_;
};

/// How a node got its place; higher values prevail.
enum class NodePlace : std::uint8_t { none, extended, cap, exact, vertex };

namespace detail {

/// Extends the heights known on some nodes of one level to the nodes connected with them by \p quads (plane nodes):
/// the constant where they are all equal within \p tolerance, else the harmonic function on the edges, weighted with
/// the inverse of their lengths. extend(p, height) is called for each. Nodes connected with no known one are left out.
template <class Known, class Extend>
void extend_heights(std::span<const Vec2> plane, std::span<const QuadCorners> quads, double tolerance, Known&& known,
                    Extend&& extend) {
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
    std::vector<Index> free(nodes.size(), no_index);
    Index free_count = 0;
    for (Index i = 0; i < nodes.size(); ++i) {
        const Index r = parts.root(i);
        if (height[i] == infinity && low[r] <= high[r]) {
            if (high[r] - low[r] <= tolerance) {
                extend(nodes[i], 0.5 * (low[r] + high[r]));
            } else {
                free[i] = free_count++;
            }
        }
    }
    if (free_count == 0) {
        return;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free_count));
    for (const auto& [a, b] : edges) {
        const double weight = 1 / std::max(1e-300, (plane[nodes[a]] - plane[nodes[b]]).norm());
        for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
            if (free[i] == no_index) {
                continue;
            }
            const int row = static_cast<int>(free[i]);
            entries.emplace_back(row, row, weight);
            if (free[j] != no_index) {
                entries.emplace_back(row, static_cast<int>(free[j]), -weight);
            } else {
                right[row] += weight * height[j];
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(free_count), static_cast<Eigen::Index>(free_count));
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::VectorXd solution = solver.solve(right);
    for (Index i = 0; i < nodes.size(); ++i) {
        if (free[i] != no_index) {
            extend(nodes[i], solution[static_cast<Eigen::Index>(free[i])]);
        }
    }
}

/// Extends values given on the first nodes of a plane mesh to all others by the discrete Laplace equation, for any
/// number of right-hand sides. Every other node must be connected with a given one.
class InnerLaplace {
public:
    InnerLaplace(std::span<const Vec2> plane, std::span<const QuadCorners> quads, std::size_t given);

    /// Values on the inner nodes, one row each, for rows of values on the given ones.
    [[nodiscard]] Eigen::MatrixX2d solve(const Eigen::MatrixX2d& given) const;

private:
    std::size_t inner_;
    Eigen::SparseMatrix<double> coupling_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

/// Fills one run of levels [first, last] of a column, whose ends are given: extended heights that do not keep a
/// distance of at least a tenth of their share from the given ones, and from each other, are dropped; all others are
/// interpolated linearly between those that remain. O(levels).
PAVIOR_INLINE void fill_column(Index plane_node, std::size_t first, std::size_t last, const ColumnNodes& nodes,
                               std::span<Vec3> places, std::span<NodePlace> how);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/column_heights-inl.hpp>
#endif
