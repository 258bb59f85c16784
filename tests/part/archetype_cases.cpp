// Touching solids of a model, with callables, that have nothing but what the concepts ask for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/extruded_cases.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/mixed_solids.hpp>

#include <functional>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A round boss on a disc: neither submapped nor swept one-to-one.
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

TEST_CASE("each solid by its own method with archetypes alone") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(2, 1), 5, 6), add_round_boss(b),
                                      add_cylinder(b, 1, 0.8, 2)};
    const archetype::Brep model(b);
    archetype::Callable<PlaneArrangement(const PlaneCurves&, const ImprintOptions&)> imprinter(imprint);
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(solved);
    archetype::Callable<PlaneQuadMesh(const PlaneRegion&)> regions(GmshRegionMesher{});
    archetype::Callable<CapMesh(FaceId, const CapBoundary&)> caps(GridCap<TestBrep>{&b});
    MixedOptions options;
    options.size = 0.5;
    options.min_loop = 16;
    const Kernels kernels{std::ref(imprinter), std::ref(solver), std::ref(regions), std::ref(caps), {}};
    const MixedSolids mesh = mixed_solids(model, solids, options, kernels, [] { return false; });
    CHECK(mesh.methods.at(solids[0]) == PartMethod::submap);
    CHECK(mesh.methods.at(solids[1]) == PartMethod::multi_sweep);
    CHECK(mesh.methods.at(solids[2]) == PartMethod::sweep);
    CHECK(imprinter.calls() > 0);
    CHECK(regions.calls() > 0);
    CHECK(caps.calls() > 0);
    CHECK(verify_hexes(mesh.mesh).volume > 2 + 14.5 + 4.8);
}
