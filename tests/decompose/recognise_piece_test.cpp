#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/decompose/recognise_piece.hpp>
#include <pavior/glpk/solve_program.hpp>

#include <cmath>
#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

PieceMethods methods_of(const TestBrep& b, SolidId solid) { return recognise_piece(b, solid, GlpkSolver{}); }

/// A disc that carries a smaller one.
SolidId add_round_boss(TestBrep& b) {
    const Ring low = add_circle(b, 2, 0), rim = add_circle(b, 2, 1), foot = add_circle(b, 1, 1),
               high = add_circle(b, 1, 2);
    return b.solid({{b.flat({{{low.e, true}}}, {0, 0, 1}), false},
                    {b.flat({{{rim.e, true}}, {{foot.e, false}}}, {0, 0, 1}), true},
                    {b.flat({{{high.e, true}}}, {0, 0, 1}), true},
                    {add_round_wall(b, low, rim), true},
                    {add_round_wall(b, foot, high), true}});
}

}  // namespace

TEST_CASE("A box is for submap and sweep, and so is an L") {
    TestBrep b;
    for (const SolidId solid : {add_prism(b, rectangle(2, 1), 0, 3), add_prism(b, l_shape(), 5, 6)}) {
        const PieceMethods methods = methods_of(b, solid);
        CHECK(methods.submap);
        CHECK(methods.sweep);
        CHECK(methods.any());
        CHECK(methods.cusps == 0);
        CHECK(cost(methods) == cost({.submap = true}));
    }
}

TEST_CASE("What is notched in three directions is for submap alone") {
    Voxels voxels(2, 2, 2);
    voxels.fill({0, 0, 0}, {2, 2, 2}, 1);
    voxels.fill({1, 1, 1}, {2, 2, 2}, 0);
    const VoxelBrep corner(voxels);
    const PieceMethods methods = methods_of(corner.brep(), SolidId{0});
    CHECK(methods.submap);
    CHECK_FALSE(methods.sweep);
}

TEST_CASE("A cylinder and a prism over a triangle are for sweep alone") {
    TestBrep b;
    for (const SolidId solid :
         {add_cylinder(b, 1, 1, 2), add_prism(b, {{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}, 5, 6)}) {
        const PieceMethods methods = methods_of(b, solid);
        CHECK(methods.sweep);
        CHECK_FALSE(methods.submap);
        CHECK(methods.any());
    }
}

TEST_CASE("A stepped extrusion is for the many-to-many sweep alone") {
    TestBrep b;
    const PieceMethods methods = methods_of(b, add_round_boss(b));
    CHECK(methods.multi_sweep);
    CHECK_FALSE(methods.sweep);
    CHECK_FALSE(methods.submap);
    CHECK(methods.leaning == 0);
}

TEST_CASE("Edges at which faces all but touch are counted") {
    const auto cusps = [](double degrees) {
        TestBrep b;
        const double t = degrees * std::numbers::pi / 180;
        return methods_of(b, add_prism(b, {{0, 0}, {3, 0}, {3 * std::cos(t), 3 * std::sin(t)}}, 0, 1)).cusps;
    };
    CHECK(cusps(10) == 1);
    CHECK(cusps(3) == 1);
    CHECK(cusps(25) == 0);
    CHECK(cusps(90) == 0);
}

TEST_CASE("Recognition needs nothing but the concepts, one solid among others, and says the same each time") {
    TestBrep b;
    const SolidId pyramid = add_pyramid(b);
    const SolidId box = add_prism(b, rectangle(2, 1), 3, 4);
    const SolidId boss = add_round_boss(b);
    const archetype::Brep model(b);
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(
        [](const IntegerProgram& program) { return solve(program); });
    CHECK_FALSE(recognise_piece(model, pyramid, solver).submap);
    CHECK_FALSE(recognise_piece(model, pyramid, solver).sweep);
    CHECK(recognise_piece(model, box, solver).submap);
    CHECK(recognise_piece(model, boss, solver).multi_sweep);
    CHECK(solver.calls() > 0);
    const PieceMethods one = methods_of(b, boss), two = methods_of(b, boss);
    CHECK(one.leaning == two.leaning);
    CHECK(cost(one) == cost(two));
}
