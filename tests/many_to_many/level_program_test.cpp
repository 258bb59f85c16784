#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/many_to_many/level_program.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {
CapLevels levels(const PolygonBody& body, double size) {
    const PlaneArrangement plane = arranged(body);
    const StackResult stacks = caps_over_cells(body.body(), body, plane);
    REQUIRE(stacks.fault.empty());
    return solve_level_program(body.body(), body, plane, stacks.stacks, size, {1e-6, 1e-5}, solved);
}
}  // namespace

TEST_CASE("levels of steps follow the heights") {
    const CapLevels result = levels(PolygonBody(steps()), 0.25);
    CHECK(result.caps == std::vector<int>{0, 4, 8});
    CHECK(result.count == 8);
    CHECK(result.worst_ratio == Approx(1));
    CHECK(result.curves[0] == 0);
    CHECK(result.curves[4] == 4);
    CHECK(result.vertices[8] == 8);
}

TEST_CASE("tops that nothing connects may share a level though their heights differ") {
    const PolygonBody body({bottom(0, {box(0, 0, 9, 2)}), top(1, {box(2, 0, 7, 2)}), top(2, {box(0, 0, 2, 2)}),
                            top(2.05, {box(7, 0, 9, 2)})});
    const CapLevels result = levels(body, 0.5);
    CHECK(result.caps == std::vector<int>{0, 2, 4, 4});
}

TEST_CASE("every cap is a level, however thin the layer") {
    const PolygonBody body({bottom(0, {box(0, 0, 6, 2)}), top(1, {box(0, 0, 2, 2)}), top(1.01, {box(2, 0, 4, 2)}),
                            top(2, {box(4, 0, 6, 2)})});
    const CapLevels result = levels(body, 0.5);
    CHECK(result.caps[1] < result.caps[2]);
    CHECK(result.caps[2] < result.caps[3]);
}

TEST_CASE("a ramp from one level to another above it is refused with the faces") {
    // Next to each other: a ramp from height 0 of the pit to 2, and a wall over the same heights.
    std::vector<PolygonCap> caps{bottom(-1, {box(0, 0, 4, 4)}), top(2, {box(0, 0, 4, 1)}), top(0, {box(0, 1, 2, 4)}),
                                 top(-2, {box(2, 1, 4, 4)})};
    caps[3].slope = {1, 0};  // from 0 at x = 2 to 2 at x = 4: meets cap 2 at its foot and cap 1 at a corner
    const PolygonBody body(caps);
    try {
        (void)levels(body, 0.5);
        FAIL("accepted");
    } catch (const UnmeshableError& error) {
        CHECK(error.code() == ErrorCode::not_sweepable);
        CHECK_FALSE(error.ids().empty());
    }
}
