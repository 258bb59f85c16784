#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/many_to_many/plane_intervals.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {
PlaneIntervals numbers(const PlaneArrangement& plane, double size) {
    const std::vector<char> wanted(plane.cells.size(), 1);
    const std::vector<double> sizes(plane.edges.size(), size);
    return plane_intervals(plane, wanted, sizes, std::numbers::pi / 4, solved);
}

double middle_point_x(const PlaneEdge& edge) { return 0.5 * (edge.points.front()[0] + edge.points.back()[0]); }

int loop_count(const PlaneArrangement&, const std::vector<OrientedPlaneEdge>& loop, const PlaneIntervals& n) {
    int sum = 0;
    for (const OrientedPlaneEdge& use : loop) {
        sum += n.numbers[use.edge];
    }
    return sum;
}
}  // namespace

TEST_CASE("rectangles side by side get equal opposite sides") {
    const PlaneArrangement plane = arranged(PolygonBody(steps()));
    const PlaneIntervals result = numbers(plane, 0.5);
    CHECK(result.mapped == 2);
    CHECK(result.worst_ratio == Approx(1));
    CHECK(result.optimal);
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        CHECK(result.numbers[e] == 4);
    }
}

TEST_CASE("every loop is even and long enough, arcs are divided by their angle") {
    const PlaneArrangement plane =
        arranged(PolygonBody({bottom(0, {{{0, 0}, {9, 0}, {0, 7}}, disc(2, 2, 0.5)}), top(1, {box(1, 1, 5, 3.3)})}));
    const PlaneIntervals result = numbers(plane, 3);
    for (const PlaneCell& cell : plane.cells) {
        for (const auto& loop : cell.loops) {
            CHECK(loop_count(plane, loop, result) % 2 == 0);
            CHECK(loop_count(plane, loop, result) >= 4);
        }
    }
    for (std::size_t c = 3; c < 4; ++c) {  // the disc
        CHECK(loop_count(plane, plane.routes[c], result) >= 8);
    }
}

TEST_CASE("a triangle gets six intervals at least, an unwanted cell nothing") {
    const PlaneArrangement plane = arranged(PolygonBody({bottom(0, {{{0, 0}, {1, 0}, {0, 1}}})}));
    CHECK(loop_count(plane, plane.cells[0].loops[0], numbers(plane, 9)) == 6);
    const std::vector<char> unwanted(1, 0);
    const std::vector<double> sizes(plane.edges.size(), 9.0);
    const PlaneIntervals free = plane_intervals(plane, unwanted, sizes, 1, solved);
    CHECK(loop_count(plane, plane.cells[0].loops[0], free) == 3);
}

TEST_CASE("edges that are given get one interval, what lies opposite follows, loops stay even") {
    const PlaneArrangement plane = arranged(PolygonBody(steps()));
    const std::vector<char> wanted(plane.cells.size(), 1);
    const std::vector<double> sizes(plane.edges.size(), 1.0);
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        std::vector<char> given(plane.edges.size(), 0);
        given[e] = 1;
        const PlaneIntervals result = plane_intervals(plane, wanted, sizes, 1, solved, given);
        CHECK(result.numbers[e] == 1);
        CHECK(result.mapped == 2);
        for (const PlaneCell& cell : plane.cells) {
            CHECK(loop_count(plane, cell.loops[0], result) % 2 == 0);
        }
    }
    const std::vector<char> all(plane.edges.size(), 1);  // quads already
    CHECK(plane_intervals(plane, wanted, sizes, 1, solved, all).numbers == std::vector<int>(plane.edges.size(), 1));
}

TEST_CASE("given edges that leave opposite sides different cost their cell its grid, not the others theirs") {
    const PlaneArrangement plane = arranged(PolygonBody({bottom(0, {box(0, 0, 4, 2)}), top(1, {box(0, 0, 2, 1)}),
                                                         top(1.5, {box(0, 1, 2, 2)}), top(2, {box(2, 0, 4, 2)})}));
    std::vector<char> given(plane.edges.size(), 0);
    for (std::size_t e = 0; e < plane.edges.size();
         ++e) {  // of the right cell: two edges on the left, one on the right
        const bool upright = std::abs(middle_point_x(plane.edges[e]) - 4) < 1e-9;
        given[e] = static_cast<char>(upright || std::abs(middle_point_x(plane.edges[e]) - 2) < 1e-9);
    }
    const std::vector<char> wanted(plane.cells.size(), 1);
    const std::vector<double> sizes(plane.edges.size(), 0.5);
    const PlaneIntervals result = plane_intervals(plane, wanted, sizes, 1, solved, given);
    CHECK(result.mapped == 0);  // all cells touch what is given
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        CHECK((given[e] == 0 || result.numbers[e] == 1));
    }
    for (const PlaneCell& cell : plane.cells) {
        CHECK(loop_count(plane, cell.loops[0], result) % 2 == 0);
    }
}
