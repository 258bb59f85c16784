#include "support/catch.hpp"

#include <pavior/part/kernels.hpp>

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

TEST_CASE("Any callables make a bundle, also such as cannot be copied, and describe nothing by default") {
    static_assert(reference_mesher<Tetrahedra>);
    static_assert(!reference_mesher<int>);
    const auto imprint = [](const PlaneCurves&, const ImprintOptions&) { return PlaneArrangement{}; };
    const auto solver = [](const IntegerProgram&) { return IntegerSolution{ProgramStatus::infeasible, 0, {}}; };
    const auto regions = [](const PlaneRegion&) { return PlaneQuadMesh{}; };
    const auto caps = [](FaceId, const CapBoundary&) { return CapMesh{}; };
    Kernels kernels{imprint, solver, regions, caps, Tetrahedra{}};
    CHECK(kernels.reference(SolidId{0}, 2.5, {}).read_seconds == 2.5);
    CHECK(kernels.solver(IntegerProgram{}).status == ProgramStatus::infeasible);
    std::string text = "as it was";
    kernels.describe(text, 1, "two", 3.0);
    CHECK(text == "as it was");
}
