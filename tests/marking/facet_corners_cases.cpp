#include "support/catch.hpp"

#include <pavior/marking/detail/facet_corners.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

using namespace pavior;

TEST_CASE("facet corners are where three directions meet, not within facets and not on straight edges") {
    // The corner of a cube at node 0, each of its three squares in two triangles; node 7 lies on the edge 0 1 in the
    // middle, node 8 within the square of nodes 0 1 4 2.
    const std::vector<Vec3> x{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 0},
                              {2, 0, 2}, {0, 2, 2}, {1, 0, 0}, {1, 1, 0}};
    const std::vector<TriCorners> triangles{{0, 2, 8}, {2, 4, 8}, {4, 1, 8}, {1, 7, 8}, {7, 0, 8},  // z = 0
                                            {0, 7, 3}, {7, 1, 5}, {7, 5, 3},                        // y = 0
                                            {0, 3, 6}, {0, 6, 2}};                                  // x = 0
    const auto normal = [&](std::size_t t) {
        const TriCorners& c = triangles[t];
        return Vec3((x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).normalized());
    };
    const std::vector<char> corner = detail::facet_corners(triangles, x.size(), normal);
    CHECK(corner == std::vector<char>{1, 0, 0, 0, 0, 0, 0, 0, 0});
}
