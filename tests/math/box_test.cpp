#include "support/catch.hpp"

#include <pavior/math/box.hpp>

#include <cmath>
#include <span>
#include <vector>

using pavior::Box;
using pavior::Vec2;
using pavior::Vec3;

TEST_CASE("A box holds the points added to it and no more") {
    Box<Vec2> box;
    CHECK(box.empty());
    CHECK(box.diagonal() == 0);
    CHECK(box.extent() == Vec2(0, 0));
    CHECK(box.centre() == Vec2(0, 0));
    CHECK(std::isinf(box.square_distance(Vec2(1, 1))));
    box.add(Vec2(4, -1));
    CHECK(!box.empty());
    CHECK(box.diagonal() == 0);
    CHECK(box.centre() == Vec2(4, -1));
    box.add(Vec2(1, 3));
    CHECK(box.low == Vec2(1, -1));
    CHECK(box.high == Vec2(4, 3));
    CHECK(box.extent() == Vec2(3, 4));
    CHECK(box.diagonal() == 5);
    CHECK(box.centre() == Vec2(2.5, 1));
    Box<Vec2> other;
    other.add(Vec2(0, 0));
    other.add(box);
    CHECK(other.low == Vec2(0, -1));
    CHECK(other.high == Vec2(4, 3));
    other.add(Box<Vec2>{});
    CHECK(other.low == Vec2(0, -1));
}

TEST_CASE("Distances from a box, and lengths beyond the root of the largest number") {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 3}};
    const Box<Vec3> box = pavior::box_round(std::span<const Vec3>(points));
    CHECK(box.square_distance(Vec3(0.5, 1, 3)) == 0);
    CHECK(box.square_distance(Vec3(-2, 1, 1)) == 4);
    CHECK(box.square_distance(Vec3(4, 6, 3)) == 25);
    const std::vector<Vec3> far{{-1e200, 0, 0}, {1e200, 0, 0}};
    CHECK(pavior::box_round(std::span<const Vec3>(far)).diagonal() == 2e200);
}
