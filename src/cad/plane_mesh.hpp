#pragma once
// Triangles of a polygon with holes in the plane, refined where the caller asks for it. Internal to the cad component;
// knows nothing of any CAD kernel.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// 1 if a, b, c turn to the left, -1 to the right, 0 on a line. Exact.
int turn(const Vec2& a, const Vec2& b, const Vec2& c);

/// Closed polygons by positions in a list of points.
using PointLoops = std::vector<std::vector<Index>>;

/// Edges of the loops that cross or touch where they share no point, each by its first point; empty if there are none.
std::vector<Index> crossing_edges(std::span<const Vec2> points, const PointLoops& loops);

/// A triangulation with the edges of the loops kept and everything else Delaunay.
class PlaneMesh {
public:
    /// The first loop is the outer one and runs counter-clockwise, holes run clockwise. Every point occurs once in one
    /// loop. Nothing if no triangulation is found: loops that cross. O(n^2)
    static std::optional<PlaneMesh> of(std::vector<Vec2> points, const PointLoops& loops);

    [[nodiscard]] std::span<const Vec2> points() const { return points_; }
    /// Counter-clockwise.
    [[nodiscard]] std::vector<TriCorners> triangles() const;

    /// How much an inner edge asks to be split: above 1 it does. Is called once an edge.
    using Badness = std::function<double(Index, Index)>;
    /// Is told of each new point and of the edge of which it is the middle.
    using Added = std::function<void(Index point, Index a, Index b)>;

    /// Halves inner edges, the worst first, until none asks for it or \p most points are added; true in the first case.
    bool refine(const Badness& badness, const Added& added, std::size_t most);

private:
    /// across[k] is the triangle beyond the edge opposite corner k, no_index at the loops.
    struct Triangle {
        TriCorners nodes{};
        std::array<Index, 3> across{no_index, no_index, no_index};
    };

    /// False if two triangles lie on one side of an edge.
    bool connect();
    [[nodiscard]] std::size_t side_of(Index triangle, Index neighbour) const;
    [[nodiscard]] bool wants_flip(Index triangle, std::size_t side) const;
    void flip(Index triangle, std::size_t side);
    void replace(Index triangle, Index old_neighbour, Index neighbour);
    /// Flips edges until those of the list, and what follows from them, are Delaunay; returns the triangles touched.
    std::vector<Index> settle(std::vector<std::pair<Index, std::size_t>> edges);
    /// Halves the edge; nothing if a triangle without area would be made. Returns the triangles touched.
    std::vector<Index> halve(Index triangle, std::size_t side);

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
};

}  // namespace pavior::detail
