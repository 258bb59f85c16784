#include "support/catch.hpp"

#include <pavior/many_to_many/plane_region.hpp>

using namespace pavior;

TEST_CASE("the points of each loop follow each other round it") {
    const PlaneRegion region{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2}, {2, 1}}, {0, 4, 7}};
    REQUIRE(region.size() == 2);
    CHECK(region.next(0, 0) == 1);
    CHECK(region.next(0, 3) == 0);
    CHECK(region.next(1, 6) == 4);
}

TEST_CASE("any callable that returns quads is a region mesher") {
    const auto none = [](const PlaneRegion& region) { return PlaneQuadMesh{region.points, {}}; };
    CHECK(region_mesher<decltype(none)>);
    CHECK_FALSE(region_mesher<int>);
}
