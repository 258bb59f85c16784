// One-to-one sweeps of a model, with callables, that have nothing but what the concepts ask for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/glpk/solve_program.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {
using SolverType = archetype::Callable<IntegerSolution(const IntegerProgram&)>;
using MesherType = archetype::Callable<CapMesh(FaceId, const CapBoundary&)>;
static_assert(integer_solver<SolverType> && cap_mesher<MesherType&>);
}  // namespace

TEST_CASE("recognition, intervals and a sweep need nothing but the concepts") {
    TestBrep b;
    add_prism(b, rectangle(2, 1), 0, 3, {}, 2);
    const archetype::Brep model(b);
    SolverType solver([](const IntegerProgram& program) { return solve(program); });
    MesherType mesher(GridCap<TestBrep>{&b});
    IntervalOptions options;
    options.size = 0.5;
    const std::vector<SweepTopology> sweeps{sweep_between(model, SolidId{0}, FaceId{0}, FaceId{1})};
    const IntervalAssignment numbers = assign_intervals(model, sweeps, options, solver);
    const ModelMesh mesh = sweep_model(model, sweeps, numbers.intervals, mesher);
    CHECK(mesh.mesh.hexes.size() == 4 * 2 * 6);
    CHECK(solver.calls() > 0);
    CHECK(mesher.calls() == 1);
    const ModelMesh expected = sweep_model(b, sweeps, numbers.intervals, GridCap<TestBrep>{&b});
    CHECK(mesh.mesh.nodes == expected.mesh.nodes);
}

TEST_CASE("intervals that contradict each other are told from an archetype of a solver") {
    IntervalSystem system;
    system.edges.resize(2);
    for (IntervalEdge& edge : system.edges) {
        edge.wish = 3;
    }
    const auto rule = [](std::vector<std::pair<std::size_t, int>> terms, int value) {
        IntervalRule result;
        result.terms = std::move(terms);
        result.value = value;
        return result;
    };
    system.rules = {rule({{0, 1}, {1, -1}}, 0), rule({{0, 1}}, 2), rule({{1, 1}}, 4)};
    SolverType solver([](const IntegerProgram& program) { return solve(program); });
    CHECK(conflicting_rules(system, {0, 1, 2}, solver) == std::vector<std::size_t>{0, 1, 2});
    CHECK(solver.calls() > 0);
}
