#include <pavior/glpk/solve_program.hpp>
#include <pavior/intervals/interval_program.hpp>

#include "support/catch.hpp"

#include <set>

using namespace pavior;
using Kind = IntervalRule::Kind;

TEST_CASE("Edges tied one to one share a variable") {
    IntervalSystem system;
    system.edges.assign(5, {3.0, 1});
    system.edges[4].lower = 4;
    system.rules = {{Kind::equal, {{0, 1}, {1, -1}}, 0, {}, {}},
                    {Kind::equal, {{4, -1}, {1, 1}}, 0, {}, {}},
                    {Kind::equal, {{2, 1}, {3, 1}}, 0, {}, {}}};
    const detail::EqualEdges classes(system, {0, 1, 2});
    CHECK(classes[0] == 0);
    CHECK(classes[1] == 0);
    CHECK(classes[4] == 0);
    CHECK(classes[2] == 2);
    CHECK(classes[3] == 3);
    CHECK(detail::EqualEdges(system, {0})[4] == 4);

    const detail::IntervalProgram program(system, {0, 1}, false);
    REQUIRE(program.program().variables.size() == 3);
    CHECK(program.program().variables[0].lower == 4);
    CHECK(program.program().rows.empty());
    CHECK(program.numbers({ProgramStatus::optimal, 0.0, {7, 2, 1}}) == std::vector<int>{7, 7, 2, 1, 7});
}

TEST_CASE("The cost of a class is exact at the breakpoints and convex") {
    IntervalSystem system;
    system.edges = {{2.3, 1}, {5.0, 1}, {40.7, 1}};
    system.rules = {{Kind::equal, {{0, 1}, {1, -1}}, 0, {}, {}}, {Kind::equal, {{1, 1}, {2, -1}}, 0, {}, {}}};
    const std::vector<int> points = detail::cost_breakpoints(1, {2.3, 5.0, 40.7});
    const std::set<int> known(points.begin(), points.end());
    for (const int n : {1, 2, 3, 4, 5, 6, 7, 40, 41}) {
        CHECK(known.count(n) == 1);
    }
    for (const int n : points) {
        IntervalSystem fixed = system;
        fixed.rules.push_back({Kind::equal, {{0, 1}}, n, {}, {}});
        const detail::IntervalProgram program(fixed, {0, 1, 2}, true);
        const auto& variables = program.program().variables;
        for (std::size_t j = 2; j < variables.size(); ++j) {
            CHECK(variables[j].cost >= variables[j - 1].cost - 1e-12);
        }
        const auto cost = [](int at) {
            return interval_cost(at, 2.3) + interval_cost(at, 5.0) + interval_cost(at, 40.7);
        };
        const IntegerSolution solution = solve(program.program());
        REQUIRE(solution.status == ProgramStatus::optimal);
        CHECK(solution.objective == Approx(cost(n) - cost(1)).margin(1e-9));
    }
}

TEST_CASE("Rules become rows") {
    IntervalSystem system;
    system.edges.assign(3, {2.0, 1});
    system.rules = {{Kind::even, {{0, 1}, {1, 1}}, 0, "even", {}},
                    {Kind::at_least, {{0, 1}, {2, 2}}, 4, "long", {}},
                    {Kind::equal, {{0, 1}, {1, 1}, {2, -1}}, 0, "equal", {}}};
    const IntegerProgram program = detail::IntervalProgram(system, {0, 1, 2}, false).program();
    REQUIRE(program.rows.size() == 3);
    CHECK(program.variables.size() == 4);
    CHECK(program.rows[0].terms.back() == std::pair<std::size_t, double>{3, -2.0});
    CHECK(program.rows[1].lower == 4);
    CHECK(program.rows[1].upper == no_bound);
    CHECK(program.rows[2].upper == 0);
    CHECK(program.rows[2].name == "equal");
}
