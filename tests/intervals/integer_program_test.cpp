#include "support/catch.hpp"

#include <pavior/intervals/integer_program.hpp>

#include <cmath>

using pavior::integer_solver;
using pavior::IntegerProgram;
using pavior::IntegerSolution;
using pavior::no_bound;
using pavior::ProgramStatus;

namespace {

// The smallest model of the concept: tries all integers of one variable.
struct OneVariableSolver {
    IntegerSolution operator()(const IntegerProgram& program) const {
        const IntegerProgram::Variable& x = program.variables.at(0);
        for (double value = x.lower; value <= x.upper; ++value) {
            bool fits = true;
            for (const IntegerProgram::Row& row : program.rows) {
                const double sum = row.terms.at(0).second * value;
                fits = fits && row.lower <= sum && sum <= row.upper;
            }
            if (fits) {
                return {ProgramStatus::optimal, x.cost * value, {value}};
            }
        }
        return {ProgramStatus::infeasible, 0.0, {}};
    }
};
struct Wordy {
    const char* operator()(const IntegerProgram&) const { return "42"; }
};

static_assert(integer_solver<OneVariableSolver>);
static_assert(!integer_solver<Wordy>);
static_assert(!integer_solver<int>);

}  // namespace

TEST_CASE("variables and rows are unbounded and integer by default") {
    IntegerProgram program;
    CHECK(program.add({.cost = 2.0, .name = "x"}) == 0);
    CHECK(program.add({.lower = 1.0, .upper = 4.0, .integer = false, .name = ""}) == 1);
    REQUIRE(program.variables.size() == 2);
    CHECK(program.variables[0].lower == 0.0);
    CHECK(program.variables[0].upper == no_bound);
    CHECK(program.variables[0].integer);
    CHECK(program.variables[0].name == "x");
    CHECK(program.variables[1].cost == 0.0);
    CHECK_FALSE(program.variables[1].integer);
    const IntegerProgram::Row row;
    CHECK(row.lower == -no_bound);
    CHECK(row.upper == no_bound);
    CHECK(std::isinf(no_bound));
}

TEST_CASE("any callable solves, and says whether there is a solution") {
    IntegerProgram program;
    program.add({.upper = 9.0, .cost = 3.0, .name = "x"});
    program.rows.push_back({.lower = 5.0, .terms = {{0, 2.0}}, .name = "twice x"});
    const OneVariableSolver solver;
    const IntegerSolution solution = solver(program);
    CHECK(solution.found());
    CHECK(solution.values == std::vector<double>{3.0});
    CHECK(solution.objective == 9.0);
    program.rows.push_back({.upper = 5.0, .terms = {{0, 2.0}}, .name = "twice x again"});
    CHECK_FALSE(solver(program).found());
    for (const auto& [status, found] : {std::pair{ProgramStatus::optimal, true},
                                        {ProgramStatus::feasible, true},
                                        {ProgramStatus::infeasible, false},
                                        {ProgramStatus::unbounded, false},
                                        {ProgramStatus::unsolved, false}}) {
        CHECK(IntegerSolution{status, 0.0, {}}.found() == found);
    }
    CHECK_FALSE(IntegerSolution{}.found());
}
