#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/marking/faces.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>
#include <string>
#include <thread>
#include <vector>

using pavior::BlockOptions;
using pavior::BlockStatus;
using pavior::SolidBlocks;
using pavior::Vec3;

namespace {

/// A box without one of its four upright quarters: an L.
pavior::ReferenceMesh angle_piece() {
    const block_cases::Case box = block_cases::box({2, 2, 2});
    pavior::TetMesh tets{box.mesh.nodes, {}};
    for (const auto& c : box.mesh.tets) {
        const Vec3 centre = (tets.nodes[c[0]] + tets.nodes[c[1]] + tets.nodes[c[2]] + tets.nodes[c[3]]) / 4;
        if (centre[0] < 0.5 || centre[1] < 0.5) {
            tets.tets.push_back(c);
        }
    }
    std::vector<pavior::Index> fresh(tets.nodes.size(), pavior::no_index);
    pavior::TetMesh used;
    for (auto c : tets.tets) {
        for (auto& i : c) {
            if (fresh[i] == pavior::no_index) {
                fresh[i] = static_cast<pavior::Index>(used.nodes.size());
                used.nodes.push_back(tets.nodes[i]);
            }
            i = fresh[i];
        }
        used.tets.push_back(c);
    }
    return pavior::make_reference_mesh(used);
}

}  // namespace

namespace {
/// A box with a pyramid on it, without its layers.
pavior::ReferenceMesh bare_pyramid() {
    pavior::ReferenceMesh mesh = block_cases::read("ref_pyramid_table58").mesh;
    mesh.layers.clear();
    return mesh;
}
}  // namespace

TEST_CASE("a solid becomes blocks in one call", "[block_solid]") {
    const SolidBlocks solid = pavior::block_solid(angle_piece());
    CHECK(solid.report.status == BlockStatus::valid);
    CHECK(solid.report.dual.valid());
    CHECK(solid.report.marking.valid);
    CHECK(solid.report.blocks.ok());
    CHECK(solid.blocks.hexes.size() == 24);  // two boxes would be 16: both sides of the angle go on
    CHECK(solid.report.blocks.mesh.volume == Approx(0.75));
    CHECK(solid.placement.min_jacobian == Approx(1));
    CHECK_FALSE(solid.fine.has_value());
    CHECK(solid.report.marking.quality == Approx(1));
    CHECK(solid.report.marking_seconds > 0);
}

TEST_CASE("the refinement is made if it is asked for", "[block_solid]") {
    BlockOptions options;
    options.refine.emplace();
    options.refine->size = 0.125;
    const SolidBlocks solid = pavior::block_solid(angle_piece(), options);
    REQUIRE(solid.fine.has_value());
    CHECK(solid.report.status == BlockStatus::valid);
    CHECK(solid.fine->mesh.hexes.size() == 3 * 64 * 2);
    CHECK(pavior::verify_hexes(solid.fine->mesh).ok());
    CHECK(solid.report.refine_seconds > 0);
}

TEST_CASE("given layers can be taken as they are", "[block_solid]") {
    BlockOptions options;
    options.mark = false;
    const SolidBlocks pyramid = pavior::block_solid(block_cases::read("ref_pyramid_table58").mesh, options);
    CHECK(pyramid.report.status == BlockStatus::valid);
    CHECK(pyramid.blocks.hexes.size() == 92);
    CHECK(pyramid.report.marking.sheets.empty());
}

TEST_CASE("a dual that is not valid is an outcome, not an error", "[block_solid]") {
    BlockOptions options;
    options.mark = false;
    pavior::ReferenceMesh pyramid = block_cases::read("ref_pyramid_table58").mesh;
    pyramid.layers.clear();
    const SolidBlocks solid = pavior::block_solid(pyramid, options);
    CHECK(solid.report.status == BlockStatus::invalid_dual);
    CHECK_FALSE(solid.report.dual.violations.empty());
    CHECK(solid.blocks.hexes.empty());
    CHECK(pavior::block_quality(solid.reference) == -1.0);
    CHECK(pavior::block_quality(block_cases::read("ref_brick_table52").mesh) == Approx(0.948683).epsilon(1e-4));
}

TEST_CASE("a reentrant curve without a cut inverts blocks", "[block_solid]") {
    BlockOptions options;
    options.mark = false;
    const SolidBlocks solid = pavior::block_solid(angle_piece(), options);
    CHECK(solid.report.status == BlockStatus::inverted_blocks);
    CHECK(solid.report.blocks.conforming());
    CHECK(solid.blocks.hexes.size() == 12);
}

TEST_CASE("blocks that stay inverted are told apart from a mesh that does not", "[block_solid]") {
    const auto ring = [](const Vec3& x) {
        const double a = 5.5 * x[0];
        return Vec3((5 + x[1]) * std::sin(a), (5 + x[1]) * std::cos(a), x[2]);
    };
    const pavior::ReferenceMesh mesh = block_cases::grid({24, 1, 1}, {}, ring).mesh;
    BlockOptions options;
    CHECK(pavior::block_solid(mesh, options).report.status == BlockStatus::inverted_blocks);
    options.refine.emplace();
    options.refine->size = 0.5;
    CHECK(pavior::block_solid(mesh, options).report.status == BlockStatus::valid);
    CHECK(to_string(BlockStatus::inverted_mesh) == "inverted_mesh");
}

TEST_CASE("the published marking can be chosen", "[block_solid]") {
    BlockOptions options;
    options.marking.marking = pavior::Marking::published;
    const SolidBlocks solid = pavior::block_solid(angle_piece(), options);
    CHECK(solid.report.status == BlockStatus::valid);
    CHECK(solid.blocks.hexes.size() == 24);
    CHECK(solid.reference.nodes == angle_piece().nodes);  // it takes the faces that exist
}

TEST_CASE("progress rises from 0 to 1, whatever is asked for", "[block_solid]") {
    const auto fractions = [](const pavior::ReferenceMesh& mesh, BlockOptions options) {
        std::vector<double> seen;
        options.progress = [&](std::string_view, double fraction) { seen.push_back(fraction); };
        static_cast<void>(pavior::block_solid(mesh, options));
        return seen;
    };
    BlockOptions plain;
    BlockOptions stopped;
    stopped.marking.propagation = pavior::Propagation::stop;
    stopped.marking.split_everything = true;
    BlockOptions published;
    published.marking.marking = pavior::Marking::published;
    BlockOptions given;
    given.mark = false;
    BlockOptions fine;
    fine.refine.emplace();
    fine.refine->size = 0.2;
    fine.refine->optimise = true;
    const pavior::ReferenceMesh pyramid = block_cases::read("ref_pyramid_table58").mesh;
    for (const pavior::ReferenceMesh& mesh : {angle_piece(), pyramid, bare_pyramid()}) {
        for (const BlockOptions& options : {plain, stopped, published, given, fine}) {
            const std::vector<double> seen = fractions(mesh, options);
            REQUIRE(seen.size() >= 2);
            CHECK(seen.front() == 0.0);
            CHECK(seen.back() == 1.0);
            CHECK(std::is_sorted(seen.begin(), seen.end()));
        }
    }
    CHECK(fractions(angle_piece(), fine).size() > 12);
}

TEST_CASE("a call that is asked to stop by its own progress ends with Stopped", "[block_solid]") {
    std::size_t reports = 0;
    BlockOptions options;
    options.refine.emplace();
    options.refine->optimise = true;
    options.progress = [&](std::string_view, double) { ++reports; };
    static_cast<void>(pavior::block_solid(angle_piece(), options));
    const std::size_t all = reports;
    REQUIRE(all > 8);
    for (std::size_t at = 1; at < all - 2; ++at) {  // nothing that takes time follows the last three
        CAPTURE(at);
        std::stop_source source;
        reports = 0;
        options.execution.stop = source.get_token();
        options.progress = [&](std::string_view, double) {
            if (++reports == at) {
                source.request_stop();
            }
        };
        CHECK_THROWS_AS(pavior::block_solid(angle_piece(), options), pavior::Stopped);
        CHECK(reports <= at + 1);
    }
}

TEST_CASE("another thread stops a call at any time, and soon", "[block_solid]") {
    const auto bend = [](const Vec3& x) { return Vec3(x[0] + 0.3 * x[2] * x[2], x[1], x[2] * (1 + x[0])); };
    const pavior::ReferenceMesh mesh = block_cases::grid({12, 12, 12}, {}, bend).mesh;
    BlockOptions options;
    options.refine.emplace();
    options.refine->size = 0.04;
    options.refine->optimise = true;
    const auto run = [&](double after) {  // seconds from the request to the end, -1: it came too late
        std::stop_source source;
        options.execution.stop = source.get_token();
        std::chrono::steady_clock::time_point asked;
        std::thread other([&] {
            std::this_thread::sleep_for(std::chrono::duration<double>(after));
            asked = std::chrono::steady_clock::now();
            source.request_stop();
        });
        double latency = -1;
        try {
            static_cast<void>(pavior::block_solid(mesh, options));
            other.join();
        } catch (const pavior::Stopped&) {
            const auto now = std::chrono::steady_clock::now();
            other.join();
            latency = std::chrono::duration<double>(now - asked).count();
        }
        return latency;
    };
    double worst = 0;
    std::size_t stopped = 0;
    for (const double after : {0.0, 0.01, 0.03, 0.06, 0.1, 0.15, 0.3}) {
        const double latency = run(after);
        stopped += latency >= 0 ? 1 : 0;
        worst = std::max(worst, latency);
    }
    std::cout << "block_solid: " << stopped << " of 7 calls stopped, at the latest after " << 1e3 * worst << " ms\n";
    CHECK(stopped >= 4);
    CHECK(worst < 1);  // 50 ms as a rule: bench/stop_bench.cpp; here other tests may hold the processors
}

TEST_CASE("progress goes from stage to stage, and threads do not change the outcome", "[block_solid]") {
    std::set<std::string> stages;
    BlockOptions options;
    options.refine.emplace();
    options.progress = [&](std::string_view stage, double fraction) {
        CHECK(fraction >= 0);
        CHECK(fraction <= 1);
        stages.insert(std::string(stage));
    };
    const SolidBlocks one = pavior::block_solid(angle_piece(), options);
    for (const char* stage : {"marking", "dual", "blocks", "refinement"}) {
        CHECK(stages.count(stage) == 1);
    }
    options.progress = {};
    options.execution = pavior::Execution{3};
    const SolidBlocks three = pavior::block_solid(angle_piece(), options);
    CHECK(one.blocks.hexes == three.blocks.hexes);
    CHECK(one.placement.positions == three.placement.positions);
    CHECK(one.fine->mesh.nodes == three.fine->mesh.nodes);
}
