#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/many_to_many/local_sizes.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/multi_sweep_solids.hpp>

#include <vector>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Many-to-many sweeps of any model, with local sizes, until time is out") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, l_shape(), 0, 1)};
    const Kernels kernels{imprint, GlpkSolver{}, GmshRegionMesher{}, {}, {}};
    MultiSweepOptions options;
    options.size = 0.5;
    const BestMultiSweep best = multi_sweep_solids(b, solids, options, kernels, [] { return false; });
    REQUIRE(best.mesh);
    CHECK(verify_hexes(best.mesh->mesh).volume == Approx(3).epsilon(1e-12));
    LocalSizes sizes;
    sizes.solid[b.tag(3, 0)] = 0.2;
    const BestMultiSweep fine = multi_sweep_solids(
        b, solids, options, kernels, [] { return false; }, sizes);
    REQUIRE(fine.mesh);
    CHECK(fine.mesh->mesh.hexes.size() > 4 * best.mesh->mesh.hexes.size());
    const BestMultiSweep none = multi_sweep_solids(b, solids, options, kernels, [] { return true; });
    CHECK(none.attempts.size() <= best.attempts.size());
}
