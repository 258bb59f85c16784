#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_lattice.hpp>
#include <pavior/submap/submap_unknowns.hpp>

#include "support/catch.hpp"

using namespace pavior;
using namespace pavior::detail;

TEST_CASE("sums of intervals") {
    const IntervalSum a{{0, 1}, {2, -1}}, b{{0, 1}, {1, 3}};
    CHECK(difference(a, b) == IntervalSum{{1, -3}, {2, -1}});
    CHECK(value(a, {5, 6, 7}) == -2);
    CHECK(difference(a, a).empty());
}

TEST_CASE("equations that follow from others are told") {
    EquationSpan span;
    CHECK(span.add({{0, 1}, {1, 1}, {2, -1}}));
    CHECK(span.add({{1, 2}, {3, -1}}));
    CHECK_FALSE(span.add({{0, 2}, {2, -2}, {3, 1}}));  // twice the first minus the second
    CHECK_FALSE(span.add({{0, -1}, {1, -1}, {2, 1}}));
    CHECK(span.add({{0, 1}, {3, 1}}));
    CHECK_FALSE(span.add({}));
}

TEST_CASE("coordinates run along a spanning tree, cycles are told, lengths fit all steps") {
    SolidUnknowns unknowns;
    for (int v = 0; v < 4; ++v) {
        CHECK(unknowns.vertex(VertexId{v}) == static_cast<std::size_t>(v));
    }
    // a square: 0 -> 1 by edge 0, 1 -> 2 across, 3 -> 2 by edge 1, 0 -> 3 across
    unknowns.steps[0] = {{0, 1, 1, 0, 2.0}, {1, 2, 0, 9, 0.0}, {3, 2, 1, 1, 4.0}, {0, 3, 0, 9, 0.0}};
    unknowns.steps[1] = unknowns.steps[2] = {{0, 1, 0, 0, 0.0}, {1, 2, 0, 0, 0.0}, {2, 3, 0, 0, 0.0}};
    unknowns.resolve();
    REQUIRE(unknowns.closing[0].size() == 1);
    CHECK(unknowns.closing[1].empty());
    CHECK(unknowns.coordinate[0][1] == IntervalSum{{0, 1}});
    const LatticeStep& step = unknowns.steps[0][unknowns.closing[0][0]];
    IntervalSum cycle = difference(unknowns.coordinate[0][step.to], unknowns.coordinate[0][step.from]);
    cycle = difference(cycle, step.sign == 0 ? IntervalSum{} : IntervalSum{{step.edge, step.sign}});
    CHECK((cycle == IntervalSum{{0, 1}, {1, -1}} || cycle == IntervalSum{{0, -1}, {1, 1}}));
    const std::vector<double>& x = unknowns.length[0];
    CHECK(x[0] == Approx(0.0).margin(1e-12));
    CHECK(x[2] == Approx(3.0));  // symmetric: 0.5 is missing in each of the four steps
    CHECK(x[1] == Approx(2.5));
    CHECK(x[3] == Approx(-0.5));
}
