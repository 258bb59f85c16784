#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/imprint/imprint.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

using namespace pavior;

namespace {

std::vector<Vec2> square(double x, double y, double side) {
    return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}, {x, y}};
}

std::vector<Vec2> circle(std::size_t n, double start) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = start + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        points.emplace_back(std::cos(angle), std::sin(angle));
    }
    points.push_back(points.front());
    return points;
}

double area(const PlaneArrangement& plane, const PlaneCell& cell) {
    double twice = 0;
    for (const auto& loop : cell.loops) {
        for (const OrientedPlaneEdge& use : loop) {
            const auto& x = plane.edges[use.edge].points;
            for (std::size_t i = 0; i + 1 < x.size(); ++i) {
                twice += (use.forward ? 1 : -1) * (x[i][0] * x[i + 1][1] - x[i][1] * x[i + 1][0]);
            }
        }
    }
    return twice / 2;
}

/// What every arrangement promises.
void verify(const PlaneCurves& curves, const PlaneArrangement& plane) {
    std::vector<std::array<int, 2>> uses(plane.edges.size(), {0, 0});
    for (std::size_t c = 0; c < plane.cells.size(); ++c) {
        CHECK(area(plane, plane.cells[c]) > 0);
        for (const auto& loop : plane.cells[c].loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const PlaneEdge& edge = plane.edges[loop[i].edge];
                const auto& next = loop[(i + 1) % loop.size()];
                CHECK(edge.vertices[loop[i].forward ? 1 : 0] == plane.edges[next.edge].vertices[next.forward ? 0 : 1]);
                CHECK(edge.cells[loop[i].forward ? 0 : 1] == c);
                ++uses[loop[i].edge][loop[i].forward ? 0 : 1];
            }
        }
    }
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(uses[e][k] == (plane.edges[e].cells[k] == no_index ? 0 : 1));
            CHECK((plane.vertices[plane.edges[e].vertices[k]] -
                   (k == 0 ? plane.edges[e].points.front() : plane.edges[e].points.back()))
                      .norm() == 0);
        }
    }
    REQUIRE(plane.routes.size() == curves.size());
    for (std::size_t c = 0; c < curves.size(); ++c) {
        Index at = plane.ends[c][0];
        for (const OrientedPlaneEdge& use : plane.routes[c]) {
            CHECK(plane.edges[use.edge].vertices[use.forward ? 0 : 1] == at);
            at = plane.edges[use.edge].vertices[use.forward ? 1 : 0];
        }
        CHECK(at == plane.ends[c][1]);
    }
}

}  // namespace

TEST_CASE("two squares that overlap make three cells") {
    PlaneCurves curves;
    curves.add(square(0, 0, 2));
    curves.add(square(1, 1, 2));
    const PlaneArrangement plane = imprint(curves, {1e-9, {}});
    verify(curves, plane);
    REQUIRE(plane.cells.size() == 3);
    std::vector<double> areas;
    for (const PlaneCell& cell : plane.cells) {
        areas.push_back(area(plane, cell));
    }
    std::sort(areas.begin(), areas.end());
    CHECK(areas[0] == Approx(1));
    CHECK(areas[1] == Approx(3));
    CHECK(areas[2] == Approx(3));
    CHECK(plane.vertices.size() == 4);  // two ends and two crossings
}

TEST_CASE("a curve inside another is a hole that runs clockwise, and a cell of its own") {
    PlaneCurves curves;
    curves.add(square(0, 0, 4));
    curves.add(square(1, 1, 1));
    const PlaneArrangement plane = imprint(curves, {1e-9, {}});
    verify(curves, plane);
    REQUIRE(plane.cells.size() == 2);
    CHECK(plane.cells[0].loops.size() == 2);
    CHECK(area(plane, plane.cells[0]) == Approx(15));
    const Vec2 inside = plane.cells[0].inside;
    CHECK((inside[0] > 0 && inside[0] < 4 && inside[1] > 0 && inside[1] < 4));
    CHECK_FALSE((inside[0] > 1 && inside[0] < 2 && inside[1] > 1 && inside[1] < 2));
}

TEST_CASE("one circle drawn twice with other points is one curve") {
    PlaneCurves curves;
    curves.add(circle(100, 0));
    curves.add(circle(73, 0.3));
    const PlaneArrangement plane = imprint(curves, {5e-3, {}});
    verify(curves, plane);
    CHECK(plane.cells.size() == 1);
    CHECK(plane.vertices.size() == 2);
    CHECK(plane.edges.size() == 2);
    CHECK(plane.routes[0].size() == 2);
    CHECK(plane.routes[1].size() == 2);
}

TEST_CASE("curves that run close together become one where both tolerances allow it") {
    PlaneCurves curves;
    curves.add(square(0, 0, 4));
    curves.add(std::vector<Vec2>{{0, 2}, {4, 2}});
    curves.add(std::vector<Vec2>{{0, 2.1}, {4, 2.1}});
    CHECK(imprint(curves, {1e-6, {}}).cells.size() == 3);
    const PlaneArrangement merged = imprint(curves, {1e-6, {0.2, 0.2, 0.2}});
    verify(curves, merged);
    CHECK(merged.cells.size() == 2);
    CHECK(merged.routes[1] == merged.routes[2]);
    CHECK(imprint(curves, {1e-6, {0.2, 0.2, 0.05}}).cells.size() == 3);
}

TEST_CASE("overlapping collinear curves share the edges that both pass") {
    PlaneCurves curves;
    curves.add(std::vector<Vec2>{{0, 0}, {3, 0}});
    curves.add(std::vector<Vec2>{{5, 0}, {2, 0}});
    const PlaneArrangement plane = imprint(curves, {1e-9, {}});
    verify(curves, plane);
    CHECK(plane.edges.size() == 3);
    CHECK(plane.cells.empty());
    CHECK(plane.routes[0].back().edge == plane.routes[1].back().edge);
    CHECK(plane.routes[0].back().forward != plane.routes[1].back().forward);
}

TEST_CASE("a curve shorter than the tolerance has no route") {
    PlaneCurves curves;
    curves.add(square(0, 0, 4));
    curves.add(std::vector<Vec2>{{2, 2}, {2.01, 2}});
    const PlaneArrangement plane = imprint(curves, {1e-6, {0.1, 0.1}});
    CHECK(plane.routes[1].empty());
    CHECK(plane.ends[1][0] == plane.ends[1][1]);
}

TEST_CASE("random lines: Euler's formula holds, twice the same") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(0, 10);
    for (int run = 0; run < 20; ++run) {
        CAPTURE(run);
        PlaneCurves curves;
        curves.add(square(0, 0, 10));
        for (int i = 0; i < 12; ++i) {
            curves.add(std::vector<Vec2>{{at(random), 0}, {at(random), at(random)}, {at(random), 10}});
        }
        const PlaneArrangement plane = imprint(curves, {1e-4, {}});
        verify(curves, plane);
        CHECK(plane.vertices.size() + plane.cells.size() == plane.edges.size() + 1);  // connected
        double sum = 0;
        for (const PlaneCell& cell : plane.cells) {
            sum += area(plane, cell);
        }
        CHECK(sum == Approx(100).epsilon(1e-3));
        const PlaneArrangement again = imprint(curves, {1e-4, {}});
        CHECK(again.routes == plane.routes);
        CHECK(again.vertices == plane.vertices);
    }
}

TEST_CASE("wrong input is named") {
    PlaneCurves curves;
    CHECK(imprint(curves, {1e-9, {}}).edges.empty());
    curves.add(square(0, 0, 1));
    CHECK_THROWS_AS(imprint(curves, {0, {}}), InputError);
    CHECK_THROWS_AS(imprint(curves, {1e-9, {1, 1}}), InputError);
    curves.add(std::vector<Vec2>{{0, 0}});
    CHECK_THROWS_WITH(imprint(curves, {1e-9, {}}), Catch::Contains("curve 1"));
    PlaneCurves bad;
    bad.add(std::vector<Vec2>{{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}});
    CHECK_THROWS_AS(imprint(bad, {1e-9, {}}), InputError);
}
