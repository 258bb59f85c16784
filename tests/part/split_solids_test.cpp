#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/model_tets.hpp"

#include <pavior/core/stop.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/split_solids.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <stop_token>
#include <utility>

using namespace pavior;
using namespace pavior::test;

namespace {

SplitOptions with_size(double size) {
    SplitOptions options;
    options.size = size;
    return options;
}

/// Every node that lies on something is there.
double farthest(const TestBrep& b, const SplitSolids& mesh) {
    double worst = 0;
    for (std::size_t i = 0; i < mesh.on.size(); ++i) {
        const NodeEntity& on = mesh.on[i];
        if (on.dimension == 3 || on.id < 0) {
            continue;
        }
        const Vec3& x = mesh.mesh.nodes[i];
        Vec3 at = x;
        if (on.dimension == 0) {
            at = b.vertex_point(VertexId{on.id});
        } else if (on.dimension == 1) {
            NearestEdge<TestBrep> nearest(b);
            at = b.edge_point(EdgeId{on.id}, nearest.closest(EdgeId{on.id}, x).t);
        } else {
            at = b.face_point(FaceId{on.id}, b.closest_on_face(FaceId{on.id}, x));
        }
        worst = std::max(worst, (at - x).norm());
    }
    return worst;
}

}  // namespace

TEST_CASE("Touching boxes conform; sizes follow the wish, quads know their faces, hexahedra their solids") {
    TestBrep b;
    const std::vector<double> x{0, 1, 3};
    const std::vector<SolidId> row = add_box_row(b, x);
    std::vector<TetSizes> asked;
    const TetMesher mesher = [&](std::span<const SolidId> solids, const TetSizes& sizes) {
        CHECK(solids.size() == 2);
        asked.push_back(sizes);
        return box_row_tets(b, x, 2);
    };
    const SplitSolids made = split_solids(b, row, with_size(0.25), mesher);
    REQUIRE(asked.size() == 1);
    CHECK(asked[0].size == 0.5);
    CHECK(asked[0].per_turn == 6);
    CHECK(made.mesh.hexes.size() == 2 * 48 * 4);
    CHECK(made.attempts.size() == 1);
    CHECK(made.attempts[0].tets == 96);
    CHECK(made.attempts[0].off == 0);
    CHECK(made.attempts[0].min_jacobian >= made.attempts[0].split_jacobian);
    CHECK(made.attempts[0].min_jacobian == Approx(hex_quality(made.mesh).scaled_jacobian.min));
    CHECK(made.limit.empty());
    const HexReport report = verify_hexes(made.mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(3).epsilon(1e-12));
    CHECK(report.boundary_quads == 10 * 8 * 3);
    CHECK(made.quads.size() == 11 * 8 * 3);
    CHECK(std::count(made.hex_solid.begin(), made.hex_solid.end(), row[1]) == 192);
    CHECK(farthest(b, made) < 1e-12);
    CHECK(std::count_if(made.on.begin(), made.on.end(), [](const NodeEntity& on) { return on.dimension == 0; }) == 12);
    for (std::size_t q = 0; q < made.quads.size(); ++q) {
        for (const Index i : made.quads[q]) {
            const Vec3& at = made.mesh.nodes[i];
            const FaceId f = made.quad_face[q];
            CHECK((b.face_point(f, b.closest_on_face(f, at)) - at).norm() < 1e-12);
        }
    }
}

TEST_CASE("The boundary of a cylinder is brought onto it, circles and all") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1, 1, 2);
    const TetMesher mesher = [&](std::span<const SolidId>, const TetSizes&) { return cylinder_tets(b, 1, 2, 8, 4); };
    const SplitSolids made = split_solids(b, std::array{solid}, with_size(0.25), mesher);
    CHECK(made.attempts[made.taken].off == 0);
    CHECK(farthest(b, made) < 1e-9);
    const HexReport report = verify_hexes(made.mesh, std::span<const QuadCorners>(made.quads));
    INFO(report.text());
    CHECK(report.ok());
    CHECK(made.attempts[made.taken].min_jacobian > 0.2);
    const double octagon = 2 * 8 * 0.5 * std::sin(2 * std::numbers::pi / 8);
    CHECK(report.volume > 0.5 * (octagon + 2 * std::numbers::pi));
    CHECK(report.volume < 2 * std::numbers::pi);
    CHECK(std::count_if(made.on.begin(), made.on.end(), [](const NodeEntity& on) { return on.dimension == 1; }) ==
          2 * (16 - 1));
    const archetype::Brep bare(b);
    archetype::Callable<SolidsTets(std::span<const SolidId>, const TetSizes&)> callable(mesher);
    const SplitSolids other = split_solids(bare, std::array{solid}, with_size(0.25), std::ref(callable));
    CHECK(other.mesh.nodes == made.mesh.nodes);
    SplitOptions threads = with_size(0.25);
    threads.execution.threads = 3;
    const SplitSolids three = split_solids(b, std::array{solid}, threads, mesher);
    CHECK(three.mesh.nodes == made.mesh.nodes);
    CHECK(three.mesh.hexes == made.mesh.hexes);
}

TEST_CASE("A mesher that fails is asked again; the best mesh counts where none is sufficient, and what limits it") {
    TestBrep b;
    const SolidId solid = add_pyramid(b);
    int calls = 0;
    const auto mesher = [&](std::span<const SolidId>, const TetSizes& sizes) -> SolidsTets {
        if (++calls == 1) {
            throw Error(ErrorCode::cad_failure, "not of size " + std::to_string(sizes.size));
        }
        return pyramid_tets(b);
    };
    SplitOptions options = with_size(1);
    options.sufficient = 0.99;
    const SplitSolids made = split_solids(b, std::array{solid}, options, mesher);
    CHECK(made.attempts.size() > 2);
    CHECK_FALSE(made.attempts[0].error.empty());
    CHECK(made.taken == 1);
    CHECK(made.mesh.hexes.size() == 8);
    CHECK(verify_hexes(made.mesh).ok());
    CHECK_FALSE(made.out_of_time);
    CHECK_THAT(made.limit, Catch::Contains("0."));
    std::set<std::pair<double, int>> sizes;
    for (const SplitAttempt& attempt : made.attempts) {
        sizes.insert({attempt.sizes.size, attempt.sizes.variant});
        CHECK(attempt.sizes.least < attempt.sizes.size);
    }
    CHECK(sizes.size() == made.attempts.size());
}

TEST_CASE("Without tetrahedra the reasons are told; too many are none; a stop is a stop") {
    TestBrep b;
    const SolidId solid = add_pyramid(b);
    const TetMesher never = [](std::span<const SolidId>, const TetSizes&) -> SolidsTets {
        throw Error(ErrorCode::cad_failure, "this one never");
    };
    try {
        static_cast<void>(split_solids(b, std::array{solid}, with_size(1), never));
        FAIL("nothing was thrown");
    } catch (const UnmeshableError& error) {
        CHECK(error.code() == ErrorCode::tetrahedra_failed);
        CHECK_THAT(error.what(), Catch::Contains("this one never"));
    }
    const TetMesher two = [&](std::span<const SolidId>, const TetSizes&) { return pyramid_tets(b); };
    SplitOptions few = with_size(1);
    few.max_hexahedra = 7;
    CHECK_THROWS_WITH(split_solids(b, std::array{solid}, few, two), Catch::Contains("8 hexahedra"));
    few.max_hexahedra = 8;
    CHECK(split_solids(b, std::array{solid}, few, two).mesh.hexes.size() == 8);
    std::stop_source source;
    SplitOptions stopped = with_size(1);
    stopped.execution.stop = source.get_token();
    const TetMesher stops = [&](std::span<const SolidId>, const TetSizes& sizes) {
        CHECK(sizes.stop.stop_possible());
        source.request_stop();
        return pyramid_tets(b);
    };
    CHECK_THROWS_AS(split_solids(b, std::array{solid}, stopped, stops), Stopped);
    CHECK_THROWS_AS(split_solids(b, std::array{solid}, with_size(0), two), InputError);
}

TEST_CASE("Where a solid is thin, shorter tetrahedra are asked for, after those that were not sufficient") {
    TestBrep b;
    const std::vector<double> x{0, 0.1};
    const std::vector<SolidId> plate = add_box_row(b, x);
    std::vector<TetSizes> asked;
    const TetMesher mesher = [&](std::span<const SolidId>, const TetSizes& sizes) {
        asked.push_back(sizes);
        return box_row_tets(b, x, 1);
    };
    SplitOptions options = with_size(0.5);
    options.sufficient = 0.9;
    const SplitSolids made = split_solids(b, plate, options, mesher);
    REQUIRE(asked.size() > 2);
    CHECK(asked[0].near.empty());
    REQUIRE_FALSE(asked[1].near.empty());
    CHECK(asked[1].size == asked[0].size);
    CHECK(asked[1].least < asked[0].least);
    for (const TetSizeAt& at : asked[1].near) {
        CHECK(at.size == Approx(0.25));
        CHECK(at.point.x() == Approx(0.05));
    }
    CHECK(asked[1].near.size() == 4);  // its short edges
    CHECK(verify_hexes(made.mesh).ok());
}

TEST_CASE("Local lengths are handed on, twice as long, and the limit of time ends the search with the best so far") {
    TestBrep b;
    const SolidId solid = add_pyramid(b);
    std::vector<TetSizes> asked;
    const TetMesher mesher = [&](std::span<const SolidId>, const TetSizes& sizes) {
        asked.push_back(sizes);
        return pyramid_tets(b);
    };
    SplitOptions options = with_size(1);
    options.local.edge[b.tag(1, 3)] = 0.25;
    options.local.face[b.tag(2, 1)] = 0.5;
    options.local.solid[b.tag(3, 0)] = 2;
    options.sufficient = 0.99;
    options.seconds = 1e-6;
    options.max_angle = 15;
    const SplitSolids made = split_solids(b, std::array{solid}, options, mesher);
    REQUIRE(asked.size() == 1);
    CHECK(asked[0].edge.at(EdgeId{3}) == 0.5);
    CHECK(asked[0].face.at(FaceId{1}) == 1);
    CHECK(asked[0].solid.at(solid) == 4);
    CHECK(asked[0].least < 0.5);
    CHECK(asked[0].per_turn == 12);
    CHECK(asked[0].seconds > 0);
    CHECK(made.out_of_time);
    CHECK(verify_hexes(made.mesh).ok());
}
