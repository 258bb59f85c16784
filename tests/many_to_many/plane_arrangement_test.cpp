#include "support/catch.hpp"

#include <pavior/many_to_many/plane_arrangement.hpp>

using namespace pavior;

TEST_CASE("curves lie one after the other") {
    PlaneCurves curves;
    CHECK(curves.size() == 0);
    curves.add(std::vector<Vec2>{{0, 0}, {1, 0}});
    curves.add(std::vector<Vec2>{{2, 0}, {2, 1}, {3, 1}});
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].size() == 2);
    CHECK(curves[1][2] == Vec2(3, 1));
}

TEST_CASE("any callable that returns an arrangement is an imprinter") {
    const auto nothing = [](const PlaneCurves&, const ImprintOptions&) { return PlaneArrangement{}; };
    const auto wrong = [](const PlaneCurves&, const ImprintOptions&) { return 1; };
    CHECK(plane_imprinter<decltype(nothing)>);
    CHECK_FALSE(plane_imprinter<decltype(wrong)>);
}
