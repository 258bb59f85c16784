#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/block_reference.hpp>
#include <pavior/part/detail/trial.hpp>
#include <pavior/part/try_method.hpp>
#include <pavior/smooth/report.hpp>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <new>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

using Caps = std::function<CapMesh(FaceId, const CapBoundary&)>;

MethodTry tried(PartMethod method, const TestBrep& b, const std::vector<SolidId>& solids, const Caps& caps) {
    const auto none = [](SolidId, double, const FeatureOptions&) -> BlockReference {
        throw Error(ErrorCode::tetrahedra_failed, "none");
    };
    const Kernels kernels{imprint, GlpkSolver{}, GmshRegionMesher{}, caps, none};
    PartOptions options;
    options.size = 0.5;
    return try_method(method, b, solids, options, kernels, {.out_of_time = [] { return false; }});
}

}  // namespace

TEST_CASE("Each method by itself meshes what it can, with notes") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, l_shape(), 0, 1)};
    for (const PartMethod method : {PartMethod::submap, PartMethod::multi_sweep, PartMethod::mixed}) {
        const MethodTry result = tried(method, b, solids, GridCap<TestBrep>{&b});
        INFO(to_string(method) << ": " << result.reason);
        CHECK(result.method == method);
        CHECK(result.outcome == TryOutcome::mesh);
        CHECK(result.hexahedra == result.data.mesh.hexes.size());
        CHECK_FALSE(result.notes.empty());
        CHECK(result.seconds > 0);
    }
    const MethodTry block = tried(PartMethod::block, b, solids, GridCap<TestBrep>{&b});
    CHECK(block.outcome == TryOutcome::refused);
    CHECK_THAT(block.reason, Catch::Contains("none"));
}

TEST_CASE("Flat hexahedra of a swept disc get a layer under the wall, and a note says so") {
    TestBrep b;
    const std::vector<SolidId> solids{add_cylinder(b, 2, 2, 1)};  // faces: wall 1, bottom 2, top 3
    const MethodTry result = tried(PartMethod::sweep, b, solids, GridCap<TestBrep>{&b});
    INFO(result.reason);
    CHECK(result.outcome == TryOutcome::mesh);
    CHECK(result.min_jacobian > 0.3);
    CHECK_THAT(result.notes.back(), Catch::Contains("a layer of hexahedra under face 1: least scaled Jacobian"));
    CHECK(result.data.hex_groups == std::vector<std::int32_t>(result.data.mesh.hexes.size(), 1));
    REQUIRE(result.data.quad_groups.size() == result.data.quads.size());
    REQUIRE(result.quad_face.size() == result.data.quads.size());
    for (std::size_t q = 0; q < result.data.quads.size(); ++q) {
        CHECK(result.data.quad_groups[q] == result.quad_face[q].value + 1);
    }
    CHECK(result.hex_solid.size() == result.hexahedra);
}

TEST_CASE("Other tetrahedra are taken where those before have no blocks, if faces are curved") {
    const std::string file = std::string(PAVIOR_EXAMPLE_DATA) + "/hexme/s15o_cylinder.stp";
    const GmshBrep cylinder = GmshBrep::load(file);
    const GmshBrep plane = GmshBrep::load(std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/2-6-19.step");
    const std::vector<SolidId> solids{SolidId{0}};
    std::vector<int> asked;
    const auto fails = [&](int number) {
        return [&asked, number](SolidId, double, const FeatureOptions&) -> BlockReference {
            asked.push_back(number);
            throw Error(ErrorCode::tetrahedra_failed, "none of " + std::to_string(number));
        };
    };
    const auto works = [&](SolidId, double size, const FeatureOptions& features) {
        asked.push_back(2);
        return read_block_reference(file, {.size = size, .features = features});
    };
    const auto blocks = [&](const AnyModel& model, std::vector<ReferenceMesher> others, bool out_of_time) {
        asked.clear();
        const Kernels kernels{imprint, GlpkSolver{}, GmshRegionMesher{}, {}, fails(1), {}, {}, {}, std::move(others)};
        PartOptions options;
        options.size = model.diagonal() / 10;
        return try_method(PartMethod::block, model, solids, options, kernels,
                          {.out_of_time = [=] { return out_of_time; }});
    };
    const MethodTry made = blocks(cylinder, {fails(3), works, fails(4)}, false);
    CHECK(made.outcome == TryOutcome::mesh);
    CHECK(made.min_jacobian >= 0.2);
    CHECK(asked == std::vector{1, 3, 2});
    const MethodTry none = blocks(cylinder, {fails(3), fails(4)}, false);
    CHECK(none.outcome == TryOutcome::refused);
    CHECK_THAT(none.reason, Catch::Contains("none of 1"));
    CHECK(asked == std::vector{1, 3, 4});
    CHECK(blocks(cylinder, {works}, true).outcome == TryOutcome::refused);
    CHECK(asked == std::vector{1});
    CHECK(blocks(plane, {fails(3)}, false).outcome == TryOutcome::refused);
    CHECK(asked == std::vector{1});
}

TEST_CASE("A mesh that is made outlives the end of the time") {
    const std::string file = std::string(PAVIOR_EXAMPLE_DATA) + "/hexme/s15o_cylinder.stp";
    const GmshBrep cylinder = GmshBrep::load(file);
    const std::vector<SolidId> solids{SolidId{0}};
    std::atomic<bool> late = false;
    const auto works = [&](SolidId, double size, const FeatureOptions& features) {
        return read_block_reference(file, {.size = size, .features = features});
    };
    const auto works_too_late = [&](SolidId solid, double size, const FeatureOptions& features) {
        late = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        return works(solid, size, features);
    };
    int third = 0;
    const auto counts = [&](SolidId solid, double size, const FeatureOptions& features) {
        ++third;
        return works(solid, size, features);
    };
    const Kernels kernels{imprint, GlpkSolver{}, GmshRegionMesher{}, {}, works, {}, {}, {}, {works_too_late, counts}};
    PartOptions options;
    options.size = cylinder.diagonal() / 10;
    options.sufficient = 0.999;  // more than there is
    std::size_t made = 0;
    const MethodTry result = try_method(PartMethod::block, cylinder, solids, options, kernels,
                                        {.out_of_time = [&] { return late.load(); }, .made = [&] { ++made; }});
    CHECK(result.outcome == TryOutcome::mesh);
    CHECK(result.min_jacobian >= 0.2);
    CHECK(made == 1);
    CHECK(third == 0);
    late = false;
    std::stop_source stop;
    options.execution.stop = stop.get_token();
    const auto stops = [&](SolidId solid, double size, const FeatureOptions& features) {
        stop.request_stop();
        return works(solid, size, features);
    };
    const Kernels stopping{imprint, GlpkSolver{}, GmshRegionMesher{}, {}, works, {}, {}, {}, {stops}};
    CHECK_THROWS_AS(
        try_method(PartMethod::block, cylinder, solids, options, stopping, {.out_of_time = [] { return false; }}),
        Stopped);
}

TEST_CASE("Whatever a kernel throws becomes the outcome, but for Stopped") {
    TestBrep b;
    const std::vector<SolidId> solids{add_cylinder(b, 1, 1, 2)};
    const auto with = [&](auto what) {
        return tried(PartMethod::sweep, b, solids, [what](FaceId, const CapBoundary&) -> CapMesh { throw what; });
    };
    CHECK(with(UnmeshableError(ErrorCode::not_sweepable, "no", {3, 1, 3})).faces == std::vector{1, 3});
    const MethodTry logic = with(std::logic_error("odd"));
    CHECK(logic.outcome == TryOutcome::died);
    CHECK(logic.reason == "odd");
    CHECK(with(std::bad_alloc()).reason == "not enough memory");
    CHECK_THROWS_AS(with(Stopped()), Stopped);
}

TEST_CASE("A trial knows the wished size and describes only to those who listen") {
    TestBrep b;
    add_prism(b, rectangle(3, 4), 0, 12);
    const AnyModel model = b;
    PartOptions options;
    Kernels kernels;
    MethodTry result;
    const std::function<bool()> never = [] { return false; };
    const detail::Trial trial{model, {}, options, kernels, never, result};
    CHECK(trial.size() == Approx(13.0 / 12));
    options.size = 0.5;
    CHECK(trial.size() == 0.5);
    const SmoothReport report;
    trial.describe(&report);
    CHECK(result.report.empty());
    kernels.describe = [](std::string& text, const AnyModel&, const MethodReport& own) {
        text = std::holds_alternative<const SmoothReport*>(own) ? "smoothed" : "something else";
    };
    trial.describe(&report);
    CHECK(result.report == "smoothed");
    kernels.solver = [](const IntegerProgram&) -> IntegerSolution {
        throw UnmeshableError(ErrorCode::bad_option, "no");
    };
    const std::vector<SolidId> solids = all_solids(b);
    detail::Trial whole{model, solids, options, kernels, never, result};
    CHECK_THROWS_AS(detail::try_submap(whole), UnmeshableError);
    CHECK_THROWS_AS(detail::try_sweep(whole), UnmeshableError);
    CHECK_THROWS_AS(detail::try_mixed(whole), UnmeshableError);
}
