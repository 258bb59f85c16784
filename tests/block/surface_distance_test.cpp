#include <pavior/block/surface_distance.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"

#include <vector>

using namespace pavior;

namespace {

const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const std::vector<TriCorners> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

}  // namespace

TEST_CASE("Closed triangles enclose their volume, wherever they are") {
    CHECK(enclosed_volume(corners, tetrahedron) == Approx(4));
    std::vector<Vec3> away = corners;
    for (Vec3& x : away) {
        x += Vec3(1000, -2000, 500);
    }
    CHECK(enclosed_volume(away, tetrahedron) == Approx(4).epsilon(1e-9));
    CHECK(enclosed_volume(corners, std::vector<TriCorners>{}) == 0);
    CHECK_THROWS_AS(enclosed_volume(corners, std::vector<TriCorners>{{0, 1, 9}}), InputError);
}

TEST_CASE("Corners and centres of quads are measured to the nearest triangle") {
    const std::vector<Vec3> nodes{{0, 0, -0.5}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -2}};
    CHECK(surface_distance(nodes, std::vector<QuadCorners>{{0, 1, 2, 3}}, corners, tetrahedron) == Approx(0.5));
    CHECK(surface_distance(nodes, std::vector<QuadCorners>{{4, 1, 2, 3}}, corners, tetrahedron) == Approx(2));
    const std::vector<Vec3> ring{{2, 0, 0}, {0, 3, 0}, {-2, 0, 0}, {0, -3, 0}};
    const std::vector<TriCorners> far_triangle{{0, 1, 2}};
    const std::vector<Vec3> high{{2, 0, 1}, {-2, 0, 1}, {0, 3, 1}};
    CHECK(surface_distance(ring, std::vector<QuadCorners>{{0, 1, 2, 3}}, high, far_triangle) > 1);
    CHECK(surface_distance(nodes, std::vector<QuadCorners>{}, corners, tetrahedron) == 0);
    CHECK(surface_distance(nodes, std::vector<QuadCorners>{{0, 1, 2, 3}}, corners, std::vector<TriCorners>{}) == 0);
    CHECK_THROWS_AS(surface_distance(nodes, std::vector<QuadCorners>{{0, 1, 2, 7}}, corners, tetrahedron), InputError);
}
