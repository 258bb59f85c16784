#include <pavior/glpk/solve_program.hpp>
#include <pavior/intervals/solve_intervals.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace pavior;
using Kind = IntervalRule::Kind;

namespace {

bool holds(const IntervalRule& rule, const std::vector<int>& n) {
    int sum = 0;
    for (const auto& [edge, coefficient] : rule.terms) {
        sum += coefficient * n[edge];
    }
    return rule.kind == Kind::equal ? sum == rule.value : rule.kind == Kind::even ? sum % 2 == 0 : sum >= rule.value;
}

bool holds(const IntervalSystem& system, const std::vector<int>& n) {
    for (std::size_t e = 0; e < n.size(); ++e) {
        if (n[e] < system.edges[e].lower) {
            return false;
        }
    }
    for (const IntervalRule& rule : system.rules) {
        if (!holds(rule, n)) {
            return false;
        }
    }
    return true;
}

/// Least cost over all numbers in [1, most]^n, infinite if nothing fits.
double enumerate(const IntervalSystem& system, int most) {
    std::vector<int> n(system.edges.size(), 1);
    double best = std::numeric_limits<double>::infinity();
    for (;;) {
        if (holds(system, n)) {
            double cost = 0;
            for (std::size_t e = 0; e < n.size(); ++e) {
                cost += interval_cost(n[e], system.edges[e].wish);
            }
            best = std::min(best, cost);
        }
        std::size_t e = 0;
        while (e < n.size() && ++n[e] > most) {
            n[e++] = 1;
        }
        if (e == n.size()) {
            return best;
        }
    }
}

IntervalSystem random_system(std::mt19937& random) {
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    IntervalSystem system;
    for (int e = 0; e < 6; ++e) {
        system.edges.push_back({std::uniform_real_distribution<double>(1.0, 4.5)(random), pick(1, 5) == 1 ? 2 : 1});
    }
    for (int r = pick(1, 4); r > 0; --r) {
        IntervalRule rule;
        rule.kind = static_cast<Kind>(pick(0, 2));
        for (std::size_t e = 0; e < 6; ++e) {
            const int coefficient = pick(-2, 1);
            if (coefficient > -2 && coefficient != 0) {
                rule.terms.emplace_back(e, coefficient);
            }
        }
        rule.value = rule.kind == Kind::even ? 0 : pick(-1, 3);
        system.rules.push_back(rule);
    }
    return system;
}

const auto exact = [](const IntegerProgram& program) { return solve(program, {60.0, 0.0}); };

}  // namespace

TEST_CASE("Small systems agree with enumeration") {
    std::mt19937 random(5);
    int solved = 0, refused = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const IntervalSystem system = random_system(random);
        const double best = enumerate(system, 6);
        const IntervalResult result = solve_intervals(system, exact);
        if (result.status == ProgramStatus::optimal) {
            ++solved;
            CHECK(holds(system, result.numbers));
            double cost = 0;
            for (std::size_t e = 0; e < 6; ++e) {
                cost += interval_cost(result.numbers[e], system.edges[e].wish);
            }
            CHECK(result.objective == Approx(cost));
            CHECK(cost <= best + 1e-9);  // numbers above 6 may be better still
            if (*std::max_element(result.numbers.begin(), result.numbers.end()) <= 6) {
                CHECK(cost == Approx(best));
            }
        } else {
            ++refused;
            CHECK(result.status == ProgramStatus::infeasible);
            CHECK(std::isinf(best));
        }
    }
    CHECK(solved > 50);
    CHECK(refused > 5);
}

TEST_CASE("A conflict is irreducible") {
    std::mt19937 random(17);
    int conflicts = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const IntervalSystem system = random_system(random);
        const IntervalResult result = solve_intervals(system, exact);
        if (result.status != ProgramStatus::infeasible) {
            continue;
        }
        ++conflicts;
        const std::vector<std::size_t> rules = conflicting_rules(system, result.rules, exact);
        REQUIRE(!rules.empty());
        IntervalSystem core{system.edges, {}};
        for (const std::size_t i : rules) {
            core.rules.push_back(system.rules[i]);
        }
        CHECK(solve_intervals(core, exact).status == ProgramStatus::infeasible);
        for (std::size_t i = 0; i < rules.size(); ++i) {
            IntervalSystem rest = core;
            rest.rules.erase(rest.rules.begin() + static_cast<std::ptrdiff_t>(i));
            CHECK(solve_intervals(rest, exact).status == ProgramStatus::optimal);
        }
    }
    CHECK(conflicts > 5);
}

TEST_CASE("Parity contradictions are found without branching for ever") {
    IntervalSystem system;  // a+b, b+c, c+a even and a+b+c = 2 k + 1 with a+b+c tied to d+d
    system.edges.assign(3, {2.0, 1});
    system.rules = {{Kind::even, {{0, 1}, {1, 1}}, 0, {}, {}},
                    {Kind::even, {{1, 1}, {2, 1}}, 0, {}, {}},
                    {Kind::equal, {{0, 1}, {2, 1}}, 7, {}, {}},
                    {Kind::at_least, {{0, 1}}, 2, {}, {}}};
    int calls = 0;
    const auto solver = [&](const IntegerProgram& program) {
        ++calls;
        return solve(program);
    };
    const IntervalResult result = solve_intervals(system, solver);
    CHECK(result.status == ProgramStatus::infeasible);
    CHECK(calls == 0);
    CHECK(conflicting_rules(system, result.rules, solver) == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("Edges without a rule take their best number, parts are solved apart") {
    IntervalSystem system;
    for (const double wish : {1.0, 1.4, 1.42, 2.45, 100.4, 3.0}) {
        system.edges.push_back({wish, 1});
    }
    system.edges.push_back({1.0, 5});
    system.rules = {{Kind::equal, {{0, 1}, {5, -1}}, 0, {}, {}}};
    int calls = 0;
    const IntervalResult result = solve_intervals(system, [&](const IntegerProgram& program) {
        ++calls;
        return exact(program);
    });
    CHECK(calls == 1);
    CHECK(std::vector<int>(result.numbers.begin() + 1, result.numbers.begin() + 5) == std::vector<int>{1, 2, 3, 100});
    CHECK(result.numbers[6] == 5);
    CHECK(result.numbers[0] == result.numbers[5]);
    CHECK(solve_intervals(IntervalSystem{}, exact).status == ProgramStatus::optimal);
}

TEST_CASE("A solver that gives up is reported as such") {
    IntervalSystem system;
    system.edges.assign(2, {2.0, 1});
    system.rules = {{Kind::even, {{0, 1}, {1, 1}}, 0, {}, {}}};
    const IntervalResult result = solve_intervals(system, [](const IntegerProgram&) { return IntegerSolution{}; });
    CHECK(result.status == ProgramStatus::unsolved);
    CHECK(result.numbers.empty());
}
