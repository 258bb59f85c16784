#pragma once
/// \file
/// Places of nodes in columns: those on caps, curves and vertices are given; levels run on smoothly from there through
/// the solid, and layers between levels are of equal height.

#include <pavior/core/compiled.hpp>
#include <pavior/core/index.hpp>
#include <pavior/math/graph_laplacian.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
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
/// the inverse of their lengths. \p known tells the height of a plane node, if there is one; \p extend is called for
/// each other. Nodes connected with no known one are left out.
PAVIOR_INLINE void extend_heights(std::span<const Vec2> plane, std::span<const QuadCorners> quads, double tolerance,
                                  const std::function<std::optional<double>(Index p)>& known,
                                  const std::function<void(Index p, double height)>& extend);

/// Extends values given on the first nodes of a plane mesh to all others by the discrete Laplace equation, for any
/// number of right-hand sides. Every other node must be connected with a given one.
class InnerLaplace {
public:
    InnerLaplace(std::span<const Vec2> plane, std::span<const QuadCorners> quads, std::size_t given);

    /// Values on the inner nodes, one row each, for rows of values on the given ones.
    [[nodiscard]] Eigen::MatrixX2d solve(const Eigen::MatrixX2d& given) const;

private:
    std::size_t inner_;
    GraphLaplacian laplacian_;
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
