#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_intervals.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/one_to_one/recognition.hpp>
#include <pavior/submap/submap_recognition.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

SubmapIntervals assign(const VoxelBrep& model, const IntervalOptions& options, const LevelOptions& levels = {}) {
    const SubmapModel submaps = recognise_submaps(model.brep(), model.solids(), {}, GlpkSolver{});
    SubmapIntervals result = assign_submap_intervals(model.brep(), {}, submaps, options, levels, GlpkSolver{});
    CHECK(overlapping_faces(model.brep(), submaps, result.numbers).empty());
    return result;
}

IntervalOptions with_size(double size) {
    IntervalOptions options;
    options.size = size;
    return options;
}

EdgeId edge_between(const TestBrep& b, const Vec3& p, const Vec3& q) {
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        const EdgeId id{static_cast<std::int32_t>(e)};
        const Vec3 a = b.vertex_point(b.edge_vertices(id)[0]), c = b.vertex_point(b.edge_vertices(id)[1]);
        if (((a - p).norm() < 1e-9 && (c - q).norm() < 1e-9) || ((a - q).norm() < 1e-9 && (c - p).norm() < 1e-9)) {
            return id;
        }
    }
    return {};
}

}  // namespace

TEST_CASE("a unit lattice is found again") {
    Voxels voxels(5, 4, 4);
    voxels.fill({0, 0, 0}, {5, 4, 3}, 1);
    voxels.fill({1, 1, 3}, {2, 3, 4}, 1);
    voxels.fill({3, 1, 0}, {4, 2, 3}, 0);
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    const SubmapIntervals found = assign(model, with_size(1));
    for (std::size_t e = 0; e < model.brep().edge_count(); ++e) {
        CHECK(found.assignment.intervals[e] ==
              std::lround(model.brep().edge_length(EdgeId{static_cast<std::int32_t>(e)})));
    }
    CHECK(found.assignment.objective == Approx(0.0).margin(1e-9));
    CHECK(found.levels_agree);
}

TEST_CASE("a web between two pockets keeps an element") {
    Voxels voxels(3, 3, 3);
    voxels.fill({0, 0, 0}, {3, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 1}, 0);
    voxels.fill({1, 1, 2}, {2, 2, 3}, 0);
    voxels.at[2] = {0.0, 1.49, 1.51, 3.0};  // rounded each for itself, the pockets would meet
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    const SubmapIntervals found = assign(model, with_size(1.5));
    const TestBrep& b = model.brep();
    const auto number = [&](const Vec3& p, const Vec3& q) {
        return found.numbers.edges[edge_between(b, p, q).index()];
    };
    CHECK(number({0, 0, 0}, {0, 0, 3}) >= 1 + number({1, 1, 0}, {1, 1, 1.49}) + number({1, 1, 1.51}, {1, 1, 3}));
}

TEST_CASE("holes side by side in one face stay apart and inside") {
    Voxels voxels(7, 3, 2);
    voxels.fill({0, 0, 0}, {7, 3, 1}, 1);
    for (const int i : {1, 3, 5}) {
        voxels.fill({i, 1, 0}, {i + 1, 2, 1}, 0);
    }
    voxels.at[0] = {0.0, 0.1, 3.0, 3.1, 6.0, 6.1, 9.0, 9.1};
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    (void)assign(model, with_size(2.0));
    const SubmapIntervals found = assign(model, with_size(100.0));
    CHECK(found.numbers.edges[edge_between(model.brep(), {0, 0, 0}, {9.1, 0, 0}).index()] == 7);
}

TEST_CASE("prescribed numbers are kept; levels give way to them") {
    Voxels voxels(3, 2, 2);
    voxels.fill({0, 0, 0}, {3, 2, 1}, 1);
    voxels.fill({1, 0, 1}, {2, 2, 2}, 1);
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    const EdgeId long_edge = edge_between(model.brep(), {0, 0, 0}, {3, 0, 0});
    IntervalOptions options = with_size(1);
    options.edge_intervals[model.brep().tag(1, long_edge.index())] = 5;
    const SubmapIntervals found = assign(model, options);
    CHECK(found.numbers.edges[long_edge.index()] == 5);
    options.edge_intervals[model.brep().tag(1, long_edge.index())] = 2;  // three pieces above
    try {
        (void)assign(model, options);
        FAIL("2 intervals against 3 edges");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::infeasible_intervals);
        CHECK(!e.ids().empty());
        CHECK(std::string(e.what()).find("opposite sides of face") != std::string::npos);
    }
}

TEST_CASE("what would touch in a corner is kept apart, in one direction where levels are distinct") {
    Voxels voxels(2, 3, 2);
    voxels.fill({0, 0, 0}, {2, 3, 1}, 1);
    voxels.fill({0, 0, 1}, {1, 1, 2}, 1);
    voxels.fill({1, 2, 1}, {2, 3, 2}, 1);
    voxels.at[0] = {0.0, 2.0, 4.0};
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    const auto along = [&](const SubmapIntervals& found) {
        return found.numbers.edges[edge_between(model.brep(), {0, 0, 0}, {4, 0, 0}).index()];
    };
    CHECK(along(assign(model, with_size(4.0))) == 3);  // else the bosses would meet in a corner
    CHECK(along(assign(model, with_size(4.0), {true, 0.1})) == 2);
    const SubmapIntervals found = assign(model, with_size(1.0), {false, 0.1});
    CHECK_FALSE(found.levels_agree);
}

TEST_CASE("nodes of edges follow the layers of the solid") {
    Voxels voxels(3, 2, 2);
    voxels.fill({0, 0, 0}, {3, 2, 1}, 1);
    voxels.fill({0, 0, 1}, {1, 2, 2}, 1);
    voxels.at[0] = {0.0, 0.7, 2.0, 3.0};
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    const SubmapIntervals found = assign(model, with_size(1.0));
    const EdgeId e = edge_between(model.brep(), {0, 0, 0}, {3, 0, 0});
    const std::vector<double>& fractions = found.fractions[e.index()];
    REQUIRE(fractions.size() == static_cast<std::size_t>(found.numbers.edges[e.index()]) + 1);
    CHECK(fractions.front() == 0.0);
    CHECK(fractions.back() == Approx(1.0));
    const bool forward = model.brep().vertex_point(model.brep().edge_vertices(e)[0])[0] < 1.0;
    CHECK(fractions[forward ? 1 : fractions.size() - 2] == Approx(forward ? 0.7 / 3 : 2.3 / 3));
}

TEST_CASE("swept and submapped solids are assigned together") {
    TestBrep b;
    const std::vector<SolidId> row = add_box_row(b, {0, 1, 3});
    const std::vector<SweepTopology> sweeps{
        sweep_between(b, row[1], b.solid_faces(row[1])[0].face, b.solid_faces(row[1])[1].face)};
    const std::vector<SolidId> first{row[0]};
    const SubmapModel submaps = recognise_submaps(b, first, {}, GlpkSolver{});
    const SubmapIntervals found = assign_submap_intervals(b, sweeps, submaps, with_size(0.5), {}, GlpkSolver{});
    CHECK(found.assignment.layers == std::vector<int>{4});
    for (const int n : found.assignment.intervals) {
        CHECK((n == 2 || n == 4));
    }
    CHECK_THROWS_AS(assign_submap_intervals(b, sweeps, submaps, IntervalOptions{}, {}, GlpkSolver{}), InputError);
}
