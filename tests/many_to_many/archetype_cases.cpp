// Many-to-many sweeps of bodies and models, with callables, that have nothing but what the concepts ask for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/extruded_cases.hpp"
#include "support/test_brep.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>

#include <functional>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

using SolverType = archetype::Callable<IntegerSolution(const IntegerProgram&)>;
using ImprinterType = archetype::Callable<PlaneArrangement(const PlaneCurves&, const ImprintOptions&)>;
using MesherType = archetype::Callable<PlaneQuadMesh(const PlaneRegion&)>;
static_assert(integer_solver<SolverType> && plane_imprinter<ImprinterType&> && region_mesher<MesherType&>);
static_assert(extruded_geometry<archetype::Geometry<PolygonBody>>);

struct Archetypes {
    ImprinterType imprinter{imprint};
    SolverType solver{solved};
    MesherType mesher{GmshRegionMesher{}};
};

}  // namespace

TEST_CASE("a body of polygons is swept with archetypes alone") {
    const PolygonBody body({bottom(0, {box(0, 0, 6, 4), disc(2, 2, 1)}), top(1, {box(3, 0, 6, 4)}),
                            top(2, {box(0, 0, 3, 4), disc(2, 2, 1)})});
    MultiSweepOptions options;
    options.size = 0.7;
    Archetypes kernels;
    const MultiSweepMesh mesh =
        multi_sweep(body.body(), archetype::Geometry(body), options, std::ref(kernels.imprinter),
                    std::ref(kernels.solver), std::ref(kernels.mesher));
    const MultiSweepMesh expected = multi_sweep(body.body(), body, options, imprint, solved, GmshRegionMesher{});
    CHECK(mesh.mesh.nodes == expected.mesh.nodes);
    CHECK(mesh.mesh.hexes == expected.mesh.hexes);
    CHECK(kernels.imprinter.calls() > 0);
    CHECK(kernels.solver.calls() > 0);
    CHECK(kernels.mesher.calls() > 0);
}

TEST_CASE("a model is swept with archetypes alone, or refused") {
    TestBrep boss;
    add_boss(boss);
    TestBrep cone;
    add_cylinder(cone, 2, 1.8, 3, 1);  // its outer wall is neither a cap nor a side
    const auto swept = [](const TestBrep& b) {
        const archetype::Brep model(b);
        const std::vector<SolidId> solids{SolidId{0}};
        MultiSweepOptions options;
        options.size = 0.5;
        Archetypes kernels;
        return best_multi_sweep(model, solids, options, kernels.imprinter, kernels.solver, kernels.mesher,
                                [] { return false; });
    };
    REQUIRE(swept(boss).mesh);
    CHECK_FALSE(swept(boss).mesh->mesh.hexes.empty());
    CHECK_THROWS_AS(swept(cone), UnmeshableError);
}
