#include <pavior/part/mesh_part.hpp>

#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/model_tets.hpp"
#include "support/test_brep.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/detail/finer_sizes.hpp>
#include <pavior/part/detail/part_text.hpp>
#include <pavior/part/sweep_solids.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Kernels for a model that is no CAD file; there are no tetrahedra.
Kernels kernels(const TestBrep& b) {
    const auto no_tetrahedra = [](SolidId, double, const FeatureOptions&) -> BlockReference {
        throw UnmeshableError(ErrorCode::tetrahedra_failed, "no tetrahedra here");
    };
    return {imprint, GlpkSolver{}, GmshRegionMesher{}, GridCap<TestBrep>{&b}, no_tetrahedra};
}

PartOptions with_size(double size) {
    PartOptions options;
    options.size = size;
    return options;
}

}  // namespace

TEST_CASE("Solids of any model are meshed, those that touch together, by the method that fits") {
    TestBrep b;
    add_prism(b, l_shape(), 0, 1);
    const std::vector<SolidId> row = add_box_row(b, {10, 11, 13});
    const PartMesh part = mesh_part(b, with_size(0.5), kernels(b));
    REQUIRE(part.valid());
    REQUIRE(part.decisions.size() == 2);
    CHECK(part.decisions[1].solids == row);
    CHECK(part.decisions[0].tries[*part.decisions[0].taken].method == PartMethod::submap);
    CHECK(part.check.verify.volume == Approx(3 + 3).epsilon(1e-12));
    CHECK(part.data.hex_groups.size() == part.check.hexahedra);
    CHECK(part.data.quad_groups.size() == part.data.quads.size());
    std::set<int> solids(part.data.hex_groups.begin(), part.data.hex_groups.end());
    CHECK(solids.size() == 3);
    CHECK(reason_of(part).empty());
}

TEST_CASE("The method can be prescribed, and its reports are handed out") {
    TestBrep b;
    add_cylinder(b, 1, 1, 2);
    PartOptions options = with_size(0.5);
    options.methods = {PartMethod::sweep};
    std::size_t layers = 0, judged = 0;
    Kernels own = kernels(b);
    own.describe = [&](std::string& text, const AnyModel& model, const MethodReport& report) {
        if (const auto* swept = std::get_if<const SweptSolids*>(&report)) {
            layers = (*swept)->mesh.solids.at(0).layers;
        }
        if (const auto* mesh = std::get_if<const JudgedMesh*>(&report)) {
            judged = (*mesh)->check.hexahedra;
            CHECK((*mesh)->data->mesh.hexes.size() == judged);
        }
        text += std::to_string(model.solid_count());
    };
    const PartMesh part = mesh_part(b, options, own);
    REQUIRE(part.valid());
    CHECK(part.decisions[0].tries.size() == 1);
    CHECK(part.decisions[0].tries[0].report == "11");
    CHECK(layers == 4);
    CHECK(judged == part.check.hexahedra);
    CHECK(part.decisions[0].tries[0].notes.size() == 1);
}

TEST_CASE("A model and callables with nothing but what the concepts ask for") {
    TestBrep b;
    add_prism(b, rectangle(2, 1.5), 0, 1);
    const archetype::Brep model(b);
    const Kernels own = kernels(b);
    archetype::Callable<PlaneArrangement(const PlaneCurves&, const ImprintOptions&)> imprinter(own.imprint);
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(own.solver);
    archetype::Callable<PlaneQuadMesh(const PlaneRegion&)> regions(own.regions);
    archetype::Callable<CapMesh(FaceId, const CapBoundary&)> caps(own.caps);
    const Kernels bare{std::ref(imprinter), std::ref(solver), std::ref(regions), std::ref(caps), own.reference};
    for (const PartMethod method : {PartMethod::submap, PartMethod::sweep, PartMethod::multi_sweep}) {
        PartOptions options = with_size(0.5);
        options.methods = {method};
        const PartMesh part = mesh_part(model, options, bare);
        CAPTURE(to_string(method), reason_of(part));
        REQUIRE(part.valid());
        CHECK(part.data.mesh.nodes == mesh_part(b, options, own).data.mesh.nodes);
        CHECK(part.check.verify.volume == Approx(3).epsilon(1e-12));
    }
    CHECK(imprinter.calls() > 0);
    CHECK(solver.calls() > 0);
    CHECK(regions.calls() > 0);
    CHECK(caps.calls() > 0);
}

TEST_CASE("What cannot be meshed has a reason for each method, and the faces") {
    TestBrep b;
    add_pyramid(b);
    const PartMesh part = mesh_part(b, with_size(0.5), kernels(b));
    CHECK_FALSE(part.complete());
    CHECK_FALSE(part.valid());
    CHECK(part.check.hexahedra == 0);
    REQUIRE(part.decisions[0].tries.size() == 4);
    for (const MethodTry& attempt : part.decisions[0].tries) {
        CHECK(attempt.outcome == TryOutcome::refused);
        CHECK_FALSE(attempt.reason.empty());
    }
    CHECK_FALSE(part.decisions[0].tries[1].faces.empty());
    CHECK_THAT(reason_of(part), Catch::Contains("block: ") && Catch::Contains("no tetrahedra here"));
}

TEST_CASE("With tetrahedra every solid has a mesh, as the last resort, which is named; unless it is forbidden") {
    TestBrep b;
    add_pyramid(b);
    Kernels own = kernels(b);
    own.tets = [&](std::span<const SolidId>, const TetSizes&) { return pyramid_tets(b); };
    PartOptions options = with_size(0.5);
    const PartMesh part = mesh_part(b, options, own);
    INFO(reason_of(part));
    REQUIRE(part.valid());
    REQUIRE(part.decisions[0].tries.size() == 5);
    const MethodTry& taken = part.decisions[0].tries[*part.decisions[0].taken];
    CHECK(taken.method == PartMethod::split);
    REQUIRE_FALSE(taken.notes.empty());
    CHECK(taken.notes[0] == "last resort: tetrahedra, each split in four");
    CHECK(part.check.hexahedra == 8);
    CHECK(part.check.verify.volume == Approx(1.0 / 3).epsilon(1e-12));
    CHECK(std::set<int>(part.data.quad_groups.begin(), part.data.quad_groups.end()).size() == 5);
    CHECK(part.entities.distance < 1e-12);
    CHECK(std::count_if(part.entities.of_node.begin(), part.entities.of_node.end(),
                        [](const NodeEntity& on) { return on.dimension == 0; }) == 5);
    options.last_resort = false;
    CHECK_FALSE(mesh_part(b, options, own).complete());
    options.methods = {PartMethod::split};
    CHECK(mesh_part(b, options, own).data.mesh.nodes == part.data.mesh.nodes);
    const PartMesh none = mesh_part(b, options, kernels(b));
    CHECK(none.decisions[0].tries[0].outcome == TryOutcome::died);
}

TEST_CASE("Solids that touch are split together and conform") {
    TestBrep b;
    const std::vector<double> x{0, 1, 3};
    add_box_row(b, x);
    Kernels own = kernels(b);
    own.tets = [&](std::span<const SolidId>, const TetSizes&) { return box_row_tets(b, x, 2); };
    PartOptions options = with_size(0.5);
    options.methods = {PartMethod::split};
    const PartMesh part = mesh_part(b, options, own);
    INFO(reason_of(part));
    REQUIRE(part.valid());
    CHECK(part.check.hexahedra == 384);
    CHECK(part.check.verify.volume == Approx(3).epsilon(1e-12));
    CHECK(std::set<int>(part.data.hex_groups.begin(), part.data.hex_groups.end()).size() == 2);
    CHECK(std::set<int>(part.data.quad_groups.begin(), part.data.quad_groups.end()).size() == 11);
}

TEST_CASE("Local sizes of edges are heeded, and names must be borne by something") {
    TestBrep b;
    add_prism(b, rectangle(2, 2), 0, 2);
    PartOptions options = with_size(1);
    const std::size_t coarse = mesh_part(b, options, kernels(b)).check.hexahedra;
    options.local.edge[b.tag(1, 0)] = 0.05;  // against the three edges opposite, which wish for two
    const PartMesh fine = mesh_part(b, options, kernels(b));
    REQUIRE(fine.valid());
    CHECK(fine.check.hexahedra > coarse);
    options.local.named["lid"] = 1;
    CHECK_THROWS_WITH(mesh_part(b, options, kernels(b)), Catch::Contains("'lid'"));
}

TEST_CASE("Progress never runs backwards, and a stop ends the call") {
    TestBrep b;
    add_pyramid(b);
    add_prism(b, l_shape(), 5, 6);
    PartOptions options = with_size(0.5);
    std::vector<double> done;
    options.progress = [&](std::string_view, double fraction) { done.push_back(fraction); };
    (void)mesh_part(b, options, kernels(b));
    REQUIRE(done.size() > 3);
    CHECK(std::is_sorted(done.begin(), done.end()));
    CHECK(done.back() == 1);
    std::stop_source source;
    options.execution.stop = source.get_token();
    options.progress = [&](std::string_view, double) { source.request_stop(); };
    CHECK_THROWS_AS(mesh_part(b, options, kernels(b)), Stopped);
}

TEST_CASE("The same bytes for any number of threads") {
    TestBrep b;
    add_prism(b, l_shape(), 0, 1);
    PartOptions options = with_size(0.2);
    const PartMesh one = mesh_part(b, options, kernels(b));
    options.execution.threads = 3;
    const PartMesh three = mesh_part(b, options, kernels(b));
    CHECK(one.data.mesh.nodes == three.data.mesh.nodes);
    CHECK(one.data.mesh.hexes == three.data.mesh.hexes);
}

TEST_CASE("Two threads mesh two models at a time, as one after the other") {
    const std::vector methods{PartMethod::submap, PartMethod::sweep};
    std::array<TestBrep, 2> models;
    add_prism(models[0], l_shape(), 0, 1);
    add_cylinder(models[1], 1, 1, 2);
    const auto meshed = [&](std::size_t i) {
        PartOptions options = with_size(0.2);
        options.methods = {methods[i]};
        options.execution.threads = 2;
        return mesh_part(models[i], options, kernels(models[i]));
    };
    std::array<PartMesh, 2> together;
    {
        std::jthread first([&] { together[0] = meshed(0); });
        std::jthread second([&] { together[1] = meshed(1); });
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const PartMesh alone = meshed(i);
        REQUIRE(together[i].valid());
        CHECK(together[i].data.mesh.nodes == alone.data.mesh.nodes);
        CHECK(together[i].data.mesh.hexes == alone.data.mesh.hexes);
    }
}

TEST_CASE("Finer sizes are tried where the CAD mesher fails, and said") {
    std::vector<std::string> warnings;
    std::vector<double> sizes;
    detail::with_finer_sizes(1.0, warnings, [&](double size, int min_loop) {
        sizes.push_back(size);
        CHECK(min_loop == (sizes.size() == 1 ? 4 : 8));
        if (sizes.size() < 3) {
            throw Error(ErrorCode::cad_failure, "no quads");
        }
    });
    CHECK(sizes == std::vector{1.0, 0.7, 0.7 * 0.7});
    CHECK(warnings.size() == 2);
    CHECK_THROWS_AS(
        detail::with_finer_sizes(1.0, warnings, [](double, int) { throw Error(ErrorCode::cad_failure, "never"); }),
        Error);
    std::size_t asked = 0;
    CHECK_THROWS_AS(detail::with_finer_sizes(1.0, warnings,
                                             [&](double, int) {
                                                 ++asked;
                                                 throw UnmeshableError(ErrorCode::not_sweepable, "no");
                                             }),
                    UnmeshableError);
    CHECK(asked == 1);
}

TEST_CASE("Paths are told in words") {
    SweepPath path;
    CHECK(text_of(path, {}) == "along (0, 0, 1)");
    CHECK(text_of(path, {7, 8}) == "parallel to edges 7, 8");
    path.axis = Axis{Vec3(1, 2, 3), Vec3::UnitX()};
    CHECK(text_of(path, {}) == "round the axis through (1, 2, 3) along (1, 0, 0)");
}
