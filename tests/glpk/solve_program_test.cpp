#include <pavior/core/error.hpp>
#include <pavior/glpk/solve_program.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <random>

using namespace pavior;

namespace {

/// Best objective over all integer points in [0, range)^n, or nothing (NaN).
double brute_force(const IntegerProgram& p, int range) {
    const std::size_t n = p.variables.size();
    std::vector<int> x(n, 0);
    double best = std::nan("");
    for (;;) {
        bool fits = true;
        for (const auto& row : p.rows) {
            double sum = 0;
            for (const auto& [j, a] : row.terms) {
                sum += a * x[j];
            }
            fits = fits && sum >= row.lower - 1e-9 && sum <= row.upper + 1e-9;
        }
        double cost = 0;
        for (std::size_t j = 0; j < n; ++j) {
            cost += p.variables[j].cost * x[j];
        }
        if (fits && !(cost >= best)) {
            best = cost;
        }
        std::size_t j = 0;
        while (j < n && ++x[j] == range) {
            x[j++] = 0;
        }
        if (j == n) {
            return best;
        }
    }
}

}  // namespace

TEST_CASE("A knapsack is solved to the integer optimum, not to the rounded relaxation") {
    IntegerProgram p;
    for (const double value : {8.0, 11.0, 6.0, 4.0}) {
        p.add({0, 1, -value, true, {}});
    }
    p.rows.push_back({-no_bound, 14, {{0, 5}, {1, 7}, {2, 4}, {3, 3}}, "weight"});
    const IntegerSolution s = solve(p);
    REQUIRE(s.status == ProgramStatus::optimal);
    CHECK(s.objective == -21);
    CHECK(s.values == std::vector<double>{0, 1, 1, 1});
}

TEST_CASE("Random programs agree with enumeration") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coefficient(-4, 4);
    int feasible = 0, infeasible = 0;
    for (int trial = 0; trial < 300; ++trial) {
        IntegerProgram p;
        for (int j = 0; j < 4; ++j) {
            p.add({0, 4, static_cast<double>(coefficient(random)), true, {}});
        }
        for (int i = 0; i < 3; ++i) {
            IntegerProgram::Row row;
            for (std::size_t j = 0; j < 4; ++j) {
                row.terms.emplace_back(j, coefficient(random));
            }
            row.lower = coefficient(random);
            row.upper = row.lower + (i == 0 ? 0 : 2);
            p.rows.push_back(row);
        }
        const double expected = brute_force(p, 5);
        const IntegerSolution s = solve(p);
        if (std::isnan(expected)) {
            ++infeasible;
            CHECK(s.status == ProgramStatus::infeasible);
        } else {
            ++feasible;
            REQUIRE(s.status == ProgramStatus::optimal);
            CHECK(s.objective == expected);
        }
    }
    CHECK(feasible > 50);
    CHECK(infeasible > 50);
}

TEST_CASE("Continuous variables are not rounded") {
    IntegerProgram p;
    p.add({0, no_bound, 1, false, {}});
    p.add({0, no_bound, 1, true, {}});
    p.rows.push_back({2.5, no_bound, {{0, 1}}, {}});
    p.rows.push_back({2.5, no_bound, {{1, 1}}, {}});
    const IntegerSolution s = solve(p);
    REQUIRE(s.status == ProgramStatus::optimal);
    CHECK(s.values[0] == Approx(2.5));
    CHECK(s.values[1] == 3.0);
}

TEST_CASE("Infeasible, no_bound and empty programs are told apart") {
    IntegerProgram odd;  // 2 x = 3
    odd.add({0, 10, 0, true, {}});
    odd.rows.push_back({3, 3, {{0, 2}}, {}});
    CHECK(solve(odd).status == ProgramStatus::infeasible);

    IntegerProgram crossed;
    crossed.add({2, 1, 0, true, {}});
    CHECK(solve(crossed).status == ProgramStatus::infeasible);

    IntegerProgram gap;  // no integer in [0.2, 0.8]
    gap.add({0.2, 0.8, 0, true, {}});
    CHECK(solve(gap).status == ProgramStatus::infeasible);

    IntegerProgram endless;
    endless.add({0, no_bound, -1, true, {}});
    CHECK(solve(endless).status == ProgramStatus::unbounded);

    const IntegerSolution nothing = solve(IntegerProgram{});
    CHECK(nothing.status == ProgramStatus::optimal);
    CHECK(nothing.values.empty());
}

TEST_CASE("Bad programs are refused with the row or variable") {
    IntegerProgram p;
    p.add({});
    p.rows.push_back({0, 1, {{1, 1.0}}, "far"});
    try {
        (void)solve(p);
        FAIL("accepted");
    } catch (const InputError& e) {
        CHECK(e.code() == ErrorCode::bad_index);
        CHECK(e.ids() == Error::Ids{0});
    }
    p.rows[0].terms = {{0, 1.0}, {0, 1.0}};
    CHECK_THROWS_AS(solve(p), InputError);
    p.rows[0].terms = {{0, std::nan("")}};
    CHECK_THROWS_AS(solve(p), InputError);
    p.rows.clear();
    p.variables[0].cost = no_bound;
    CHECK_THROWS_AS(solve(p), InputError);
    p.variables[0].cost = 0;
    CHECK_THROWS_AS(solve(p, {0.0, 0.0}), InputError);
}
