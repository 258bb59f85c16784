#include "support/archetypes.hpp"
#include "support/catch.hpp"

#include <pavior/part/kernels.hpp>

#include <functional>

using namespace pavior;

namespace {

struct Tetrahedra {
    BlockReference operator()(SolidId, double size, const FeatureOptions&) const {
        BlockReference result;
        result.read_seconds = size;
        return result;
    }
};

}  // namespace

TEST_CASE("Any callables make a bundle, those that cannot be copied by reference") {
    static_assert(reference_mesher<Tetrahedra>);
    static_assert(!reference_mesher<int>);
    static_assert(tet_mesher<TetMesher>);
    static_assert(!tet_mesher<Tetrahedra>);
    const auto imprint = [](const PlaneCurves&, const ImprintOptions&) { return PlaneArrangement{}; };
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver([](const IntegerProgram&) {
        return IntegerSolution{ProgramStatus::infeasible, 0, {}};
    });
    const auto regions = [](const PlaneRegion&) { return PlaneQuadMesh{}; };
    const auto caps = [](FaceId, const CapBoundary&) { return CapMesh{}; };
    const Kernels kernels{imprint, std::ref(solver), regions, caps, Tetrahedra{}};
    CHECK(kernels.reference(SolidId{0}, 2.5, {}).read_seconds == 2.5);
    CHECK(kernels.solver(IntegerProgram{}).status == ProgramStatus::infeasible);
    CHECK(solver.calls() == 1);
    CHECK_FALSE(kernels.describe);
    CHECK_FALSE(kernels.tets);
}
