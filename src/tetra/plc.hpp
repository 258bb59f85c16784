#pragma once
// What the tetrahedralizers work on, and what they hand back. Internal to the tetra component.

#include <pavior/mesh/tagged_mesh.hpp>

#include <span>
#include <vector>

namespace pavior::detail {

/// Coordinates moved to a box of size 1 or so: (x - origin) * 2^-exponent, exact for the nodes it was made of.
struct Frame {
    Vec3 origin = Vec3::Zero();
    int exponent = 0;

    [[nodiscard]] Vec3 inside(const Vec3& x) const;
    [[nodiscard]] Vec3 outside(const Vec3& y) const;
};

/// The frame of a set of finite points.
[[nodiscard]] Frame frame_of(std::span<const Vec3> nodes);

/// A piecewise linear complex of triangles, in the coordinates of `frame`. Facets carry a number that what is made of
/// them inherits; so do edges.
struct Plc {
    Frame frame;
    std::vector<Vec3> nodes;
    std::vector<TriCorners> facets;
    std::vector<int> facet_numbers;
    std::vector<TaggedEdge> edges;  ///< `tag` is the number
    std::vector<Vec3> holes;        ///< a point inside each cavity
};

/// Tetrahedra as an engine made them: orientation, cavities and flat ones are not looked at yet.
struct RawTets {
    std::vector<double> nodes;  ///< x y z, in the coordinates of the frame
    std::vector<int> tets;
    std::vector<int> facets;
    std::vector<int> facet_numbers;
    std::vector<int> edges;
    std::vector<int> edge_numbers;
};

/// One point in each cavity: strictly inside a closed shell of \p triangles whose normals point into it.
[[nodiscard]] std::vector<Vec3> cavity_points(std::span<const Vec3> nodes, std::span<const TriCorners> triangles);

}  // namespace pavior::detail
