// Submapping of a model, with a solver, that have nothing but what the concepts ask for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_model.hpp>

#include <vector>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("submapping needs nothing but the concepts") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, l_shape(), 0, 2)};
    const archetype::Brep model(b);
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(
        [](const IntegerProgram& program) { return solve(program); });
    IntervalOptions options;
    options.size = 0.5;
    const SubmappedMesh mesh = submap_model(model, solids, options, solver);
    CHECK(mesh.mesh.hexes.size() == 12 * 4);
    CHECK(solver.calls() > 0);
    CHECK(mesh.mesh.nodes == submap_model(b, solids, options, GlpkSolver{}).mesh.nodes);
}

TEST_CASE("what cannot be submapped is refused through an archetype of a solver") {
    TestBrep b;
    const std::vector<SolidId> solids{add_pyramid(b)};
    const archetype::Brep model(b);
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(
        [](const IntegerProgram& program) { return solve(program); });
    CHECK_THROWS_AS(recognise_submaps(model, solids, SubmapOptions{}, solver), UnmeshableError);
}
