#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/kernels.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

using namespace pavior;
using namespace pavior::test;

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
    CHECK_FALSE(kernels.cut);
    CHECK(kernels.other_references.empty());
}

TEST_CASE("A cutter of any model makes pieces that look alike") {
    static_assert(solid_pieces<ModelPieces>);
    static_assert(solid_cutter<SolidCutter, ModelPieces>);
    TestBrep b;
    add_prism(b, rectangle(1, 1), 0, 1);
    std::size_t cuts = 0;
    Kernels kernels;
    kernels.cut = [&](std::span<const SolidCut> asked) -> std::optional<ModelPieces> {
        cuts += asked.size();
        return ModelPieces{std::make_shared<const AnyModel>(b), {SolidId{0}}, {}, [] { return std::vector<FaceId>{}; }};
    };
    const std::vector<SolidCut> two(2);
    const std::optional<ModelPieces> pieces = kernels.cut(two);
    REQUIRE(pieces);
    CHECK(cuts == 2);
    CHECK(pieces->model->face_count() == 6);
    CHECK(pieces->identify().empty());
}
