#pragma once
// Quads of a region of the plane between given boundary nodes. Internal to the cad component.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pavior::detail {

/// Closed polygons: loop l is points[offsets[l]] .. points[offsets[l + 1] - 1], the outer one first and
/// counter-clockwise, the holes clockwise.
struct PlaneLoops {
    std::vector<Vec2> points;
    std::vector<std::size_t> offsets{0};

    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
    [[nodiscard]] std::size_t next(std::size_t loop, std::size_t i) const {
        return i + 1 < offsets[loop + 1] ? i + 1 : offsets[loop];
    }
};

/// Quads counter-clockwise; the first nodes are those of the loops, in their order.
struct PlaneQuads {
    std::vector<Vec2> nodes;
    std::vector<QuadCorners> quads;
};

/// One way to let Gmsh make quads.
struct QuadRecipe {
    int algorithm = 6;   ///< Mesh.Algorithm
    int topology = 5;    ///< Mesh.RecombineOptimizeTopology
    double scale = 1;    ///< factor on the sizes inside
    int smoothing = 10;  ///< Mesh.Smoothing
};

/// The grid of a region with four corners whose opposite sides have equally many nodes; nothing for other regions.
std::optional<PlaneQuads> grid_quads(const PlaneLoops& loops);

/// Triangles of Gmsh, recombined. \p size: of the inner elements, 0: from the boundary. Nothing if a triangle is left,
/// a boundary node is missing, or Gmsh fails.
std::optional<PlaneQuads> recombined_quads(const PlaneLoops& loops, double size, const QuadRecipe& recipe);

/// Triangles between every second boundary node, from the node \p first (0 or 1) of each loop on, each cut into three
/// quads; every loop must have evenly many nodes. Always all-quad; nothing if Gmsh fails.
std::optional<PlaneQuads> subdivided_triangles(const PlaneLoops& loops, double size, std::size_t first = 0);

/// \p quads between the loops with one more layer of quads along all loops, so that no corner of a quad has to span a
/// straight or reflex angle of the boundary. The inner nodes of the layer lie a little inside; quads may be folded
/// until they are smoothed.
PlaneQuads pillowed(const PlaneQuads& quads, const PlaneLoops& loops);

/// The smallest determinant of unit edge vectors at a corner: 1 for rectangles, <= 0 for folded quads.
double smallest_corner(std::span<const Vec2> nodes, std::span<const QuadCorners> quads);

}  // namespace pavior::detail
