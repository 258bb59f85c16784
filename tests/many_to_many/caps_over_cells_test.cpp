#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/many_to_many/caps_over_cells.hpp>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("each cell gets the caps over it from bottom to top") {
    const PolygonBody body(steps());
    const PlaneArrangement plane = arranged(body);
    REQUIRE(plane.cells.size() == 2);
    const StackResult result = caps_over_cells(body.body(), body, plane);
    REQUIRE(result.fault.empty());
    for (std::size_t c = 0; c < 2; ++c) {
        const Index upper = plane.cells[c].inside[0] < 2 ? 2 : 1;
        CHECK(result.stacks[c].caps == std::vector<Index>{0, upper});
        CHECK(result.stacks[c].heights == std::vector<double>{0, upper == 2 ? 2.0 : 1.0});
    }
}

TEST_CASE("a hole belongs to no cap, an island in it does") {
    const std::vector<std::vector<Vec2>> loops{box(0, 0, 9, 9), box(2, 2, 7, 7), box(4, 4, 5, 5)};
    const PolygonBody body({bottom(0, loops), top(1, loops)});
    const PlaneArrangement plane = arranged(body);
    const StackResult result = caps_over_cells(body.body(), body, plane);
    REQUIRE(plane.cells.size() == 3);
    for (std::size_t c = 0; c < 3; ++c) {
        const Vec2 at = plane.cells[c].inside;
        const bool ring = at.minCoeff() > 2 && at.maxCoeff() < 7 && !(at.minCoeff() > 4 && at.maxCoeff() < 5);
        CHECK(result.stacks[c].caps.size() == (ring ? 0 : 2));
    }
}

TEST_CASE("a body that is not closed, or whose caps cross, is a fault") {
    const PolygonBody open({bottom(0, {box(0, 0, 1, 1)})});
    CHECK_THAT(caps_over_cells(open.body(), open, arranged(open)).fault, Catch::Contains("nothing closes"));
    const PolygonBody twisted({top(0, {box(0, 0, 1, 1)}), bottom(1, {box(0, 0, 1, 1)})});
    CHECK_THAT(caps_over_cells(twisted.body(), twisted, arranged(twisted)).fault, Catch::Contains("cross"));
}

TEST_CASE("a cap that the merging of curves destroyed is a fault that names it and its curves") {
    std::vector<PolygonCap> caps = steps();
    caps[1].loops = {box(2, 0, 4, 2)};
    caps.push_back(top(1.5, {box(1.9, 0, 2, 2)}));
    caps[2].loops = {box(0, 0, 1.9, 2)};
    const PolygonBody body(caps);
    const std::vector<double> merge(body.body().curves.size(), 0.2);
    const StackResult result = caps_over_cells(body.body(), body, imprint(body.body().plane, {1e-6, merge}));
    CHECK_FALSE(result.fault.empty());
    CHECK(result.tags == std::vector<int>{3});
    CHECK(result.curves.size() == 4);
}

TEST_CASE("a wall that the merging of curves closed is a fault") {
    // Two through holes, 0.1 apart, with sides x = 1.95 (curves 5 and 17) and x = 2.05 (11 and 23) that face each
    // other.
    const std::vector<std::vector<Vec2>> loops{box(0, 0, 4, 2), box(1, 0.5, 1.95, 1.5), box(2.05, 0.5, 3, 1.5)};
    const PolygonBody body({bottom(0, loops), top(2, loops)});
    ExtrudedBody sided = body.body();
    REQUIRE(sided.plane[5].front() == Vec2(1.95, 0.5));
    REQUIRE(sided.plane[11].back() == Vec2(2.05, 0.5));
    sided.sides = {{{5, 17}, 100}, {{11, 23}, 101}};
    CHECK(caps_over_cells(sided, body, imprint(sided.plane, {1e-6, {}})).fault.empty());
    std::vector<double> merge(sided.curves.size(), 0.2);
    const StackResult closed = caps_over_cells(sided, body, imprint(sided.plane, {1e-6, merge}));
    CHECK_FALSE(closed.fault.empty());
    CHECK_FALSE(closed.curves.empty());
}

TEST_CASE("a side that the corner of a cavity would dent is a fault") {
    // The cavity, from height 1 to 3, has a corner 0.1 from the side x = 0 (curves 3 and 7).
    const std::vector<Vec2> cavity{{0.1, 1}, {1, 0.5}, {2, 1}, {1, 1.5}};
    const PolygonBody body(
        {bottom(0, {box(0, 0, 4, 2)}), top(4, {box(0, 0, 4, 2)}), top(1, {cavity}), bottom(3, {cavity})});
    ExtrudedBody sided = body.body();
    REQUIRE(sided.plane[3].back() == Vec2(0, 0));
    REQUIRE(sided.plane[7].back() == Vec2(0, 0));
    sided.sides = {{{3, 7}, 100}};
    CHECK(caps_over_cells(sided, body, imprint(sided.plane, {1e-6, {}}), 1e-4).fault.empty());
    const std::vector<double> merge(sided.curves.size(), 0.2);
    const StackResult dented = caps_over_cells(sided, body, imprint(sided.plane, {1e-6, merge}), 1e-4);
    CHECK_THAT(dented.fault, Catch::Contains("face 100: closer to edge"));
    CHECK(dented.tags == std::vector<int>{100});
    CHECK(dented.curves.size() == 3);
    CHECK(caps_over_cells(sided, body, imprint(sided.plane, {1e-6, merge}), 0.2).fault.empty());
}
