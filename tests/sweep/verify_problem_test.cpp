#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/verify_quads.hpp>
#include <pavior/mesh/verify_report.hpp>
#include <pavior/sweep/verify_problem.hpp>

#include <algorithm>
#include <limits>
#include <string>

using namespace pavior;
using namespace pavior::test;

namespace {

SweepProblem good() { return grid_problem(straight(), {.cells = 4, .hole = 2}); }

// The only finding, or a failure.
ProblemFinding finding(const SweepProblem& problem) {
    const std::vector<ProblemFinding> findings = verify_problem(problem);
    REQUIRE(!findings.empty());
    CHECK_THROWS_AS(require_valid(problem), InputError);
    return findings.front();
}

void set_level(SweepProblem& problem, std::size_t k, const std::function<Vec3(const Vec3&)>& move) {
    const std::size_t m = problem.loops.nodes.size();
    for (std::size_t i = 0; i < m; ++i) {
        problem.boundary_levels[k * m + i] = move(problem.boundary_levels[k * m + i]);
    }
}

void reverse_loop(SweepProblem& problem, std::size_t loop) {
    const auto first = static_cast<std::ptrdiff_t>(problem.loops.offsets[loop]);
    const auto last = static_cast<std::ptrdiff_t>(problem.loops.offsets[loop + 1]);
    const std::size_t m = problem.loops.nodes.size();
    std::reverse(problem.loops.nodes.begin() + first, problem.loops.nodes.begin() + last);
    for (std::size_t k = 0; k <= problem.layers; ++k) {
        const auto level = problem.boundary_levels.begin() + static_cast<std::ptrdiff_t>(k * m);
        std::reverse(level + first, level + last);
    }
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("sound problems pass") {
    CHECK(verify_problem(good()).empty());
    CHECK(verify_problem(grid_problem(twisted())).empty());
    CHECK(verify_problem(grid_problem(warped())).empty());
    CHECK(verify_problem(grid_problem(straight(), {.layers = 1})).empty());
    CHECK_NOTHROW(require_valid(good()));
}

TEST_CASE("empty parts") {
    CHECK(finding({}).code == ErrorCode::empty_input);
    SweepProblem problem = good();
    problem.loops = {};
    problem.boundary_levels.clear();
    CHECK(finding(problem).code == ErrorCode::empty_input);
    problem = good();
    problem.layers = 0;
    problem.boundary_levels.resize(problem.loops.nodes.size());
    CHECK(finding(problem).code == ErrorCode::empty_input);
    problem = good();
    problem.source_nodes.clear();
    CHECK(finding(problem).code == ErrorCode::empty_input);
}

TEST_CASE("sizes") {
    SweepProblem problem = good();
    problem.target_nodes.pop_back();
    CHECK(finding(problem).code == ErrorCode::size_mismatch);
    problem = good();
    problem.boundary_levels.pop_back();
    CHECK(finding(problem).code == ErrorCode::size_mismatch);
    problem = good();
    problem.layers += 1;
    CHECK(finding(problem).code == ErrorCode::size_mismatch);
    problem = good();
    problem.loops.offsets.back() -= 1;
    CHECK(finding(problem).code == ErrorCode::size_mismatch);
}

TEST_CASE("coordinates that are not finite, and their ids") {
    for (const double bad : {not_a_number, infinite, -infinite}) {
        SweepProblem problem = good();
        problem.source_nodes[3][1] = bad;
        CHECK(finding(problem).code == ErrorCode::not_finite);
        CHECK(finding(problem).ids == Error::Ids{3});
        problem = good();
        problem.target_nodes[5][2] = bad;
        CHECK(finding(problem).code == ErrorCode::not_finite);
        CHECK(finding(problem).ids == Error::Ids{5});
        problem = good();
        problem.boundary_levels[2 * problem.loops.nodes.size() + 1][0] = bad;
        CHECK(finding(problem).code == ErrorCode::not_finite);
        CHECK(finding(problem).ids == Error::Ids{2});
    }
    const SweepProblem huge = moved(good(), [](const Vec3& x) { return Vec3(x * 1e305); });
    CHECK(finding(huge).code == ErrorCode::overflow);
}

TEST_CASE("the mesh") {
    SweepProblem problem = good();
    problem.quads[2][1] = 999;
    CHECK(finding(problem).code == ErrorCode::bad_index);
    CHECK(finding(problem).ids == Error::Ids{2});
    problem = good();
    problem.quads[2][1] = problem.quads[2][0];
    CHECK(finding(problem).code == ErrorCode::bad_index);
    problem = good();
    problem.quads.push_back(problem.quads[0]);
    CHECK(finding(problem).code == ErrorCode::bad_orientation);
    problem = good();
    std::reverse(problem.quads[1].begin(), problem.quads[1].end());
    CHECK(finding(problem).code == ErrorCode::bad_orientation);
    problem = good();
    problem.source_nodes.emplace_back(0, 0, 5);
    problem.target_nodes.emplace_back(0, 0, 5);
    CHECK(finding(problem).code == ErrorCode::unused_node);
    CHECK(finding(problem).ids == Error::Ids{static_cast<std::int64_t>(problem.source_nodes.size()) - 1});
}

TEST_CASE("two quads that share one node only are not a surface") {
    SweepProblem problem;
    problem.source_nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
    problem.quads = {{0, 1, 2, 3}, {2, 4, 5, 6}};
    problem.target_nodes = problem.source_nodes;
    problem.loops.add(std::vector<Index>{0, 1, 2, 4, 5, 6, 2, 3});
    problem.layers = 1;
    for (int k = 0; k < 2; ++k) {
        for (const Index i : problem.loops.nodes) {
            problem.boundary_levels.push_back(problem.source_nodes[i]);
        }
    }
    CHECK(finding(problem).code == ErrorCode::non_manifold);
    CHECK(finding(problem).ids == Error::Ids{2});
}

TEST_CASE("loops that are not the boundary") {
    const auto expect = [](const SweepProblem& problem) {
        CHECK(finding(problem).code == ErrorCode::loops_do_not_match_mesh);
        return finding(problem);
    };
    const SweepProblem sound = good();
    const std::size_t outer = sound.loops[0].size();
    SweepProblem problem = sound;  // the hole forgotten
    problem.loops.nodes.resize(outer);
    problem.loops.offsets.pop_back();
    problem.boundary_levels.clear();
    for (std::size_t k = 0; k <= sound.layers; ++k) {
        const auto level = sound.level(k);
        problem.boundary_levels.insert(problem.boundary_levels.end(), level.begin(),
                                       level.begin() + static_cast<std::ptrdiff_t>(outer));
    }
    expect(problem);

    problem = sound;  // only the hole runs the wrong way
    reverse_loop(problem, 1);
    CHECK(expect(problem).ids == Error::Ids{1});
    problem = sound;
    reverse_loop(problem, 0);
    CHECK(expect(problem).ids == Error::Ids{0});

    problem = sound;  // two nodes exchanged
    std::swap(problem.loops.nodes[1], problem.loops.nodes[2]);
    expect(problem);
    problem = sound;  // a node twice
    problem.loops.nodes[1] = problem.loops.nodes[0];
    CHECK(expect(problem).ids == Error::Ids{sound.loops.nodes[0]});
    problem = sound;  // an empty loop
    problem.loops.offsets.push_back(problem.loops.nodes.size());
    expect(problem);
    problem = sound;  // both loops written as one
    problem.loops.offsets.erase(problem.loops.offsets.begin() + 1);
    expect(problem);
    problem = sound;
    problem.loops.nodes[1] = 999;
    CHECK(finding(problem).code == ErrorCode::bad_index);
    CHECK(finding(problem).ids == Error::Ids{999});

    problem = grid_problem(straight());  // an inner node in the loop
    problem.loops.nodes[3] = 8;
    CHECK(expect(problem).ids == Error::Ids{8});
}

TEST_CASE("a closed sheet of quads beside the cap has no boundary to sweep") {
    SweepProblem problem = good();
    const auto first = static_cast<Index>(problem.source_nodes.size());
    for (int i = 0; i < 8; ++i) {
        problem.source_nodes.emplace_back(5.0 + (i & 1), (i >> 1) & 1, (i >> 2) & 1);
    }
    problem.target_nodes.insert(problem.target_nodes.end(), problem.source_nodes.end() - 8, problem.source_nodes.end());
    for (const QuadCorners& q : {QuadCorners{0, 2, 3, 1}, QuadCorners{4, 5, 7, 6}, QuadCorners{0, 1, 5, 4},
                                 QuadCorners{2, 6, 7, 3}, QuadCorners{0, 4, 6, 2}, QuadCorners{1, 3, 7, 5}}) {
        problem.quads.push_back({first + q[0], first + q[1], first + q[2], first + q[3]});
    }
    CHECK(finding(problem).code == ErrorCode::loops_do_not_match_mesh);
    CHECK(finding(problem).ids == Error::Ids{first});
}

TEST_CASE("all loops reversed is no fault") {
    SweepProblem problem = good();
    reverse_loop(problem, 0);
    reverse_loop(problem, 1);
    CHECK(verify_problem(problem).empty());
}

TEST_CASE("boundary nodes away from their levels") {
    SweepProblem problem = good();
    const Index i = problem.loops.nodes[4];
    problem.source_nodes[i][0] += 1e-3;
    CHECK(finding(problem).code == ErrorCode::inconsistent_boundary);
    CHECK(finding(problem).ids == Error::Ids{i});
    problem = good();
    problem.target_nodes[i][2] -= 1e-6;
    CHECK(finding(problem).code == ErrorCode::inconsistent_boundary);
    problem = good();
    problem.target_nodes[i][2] -= 1e-10;
    CHECK(verify_problem(problem).empty());
    CHECK(!verify_problem(problem, {.boundary_tolerance = 1e-12}).empty());
    // The tolerance is relative to the size of the loops, not to their place.
    problem = moved(good(), [](const Vec3& x) { return Vec3(x * 1e-6 + Vec3(3, 4, 5)); });
    problem.source_nodes[i][0] += 1e-9;
    CHECK(finding(problem).code == ErrorCode::inconsistent_boundary);
}

TEST_CASE("levels without a plane or without an area") {
    const auto on_a_line = [](const Vec3& x) { return Vec3(x[0], 2 * x[0], 3 * x[0]); };
    const auto in_a_point = [](const Vec3&) { return Vec3(1, 2, 3); };
    for (const auto& move :
         {std::function<Vec3(const Vec3&)>(on_a_line), std::function<Vec3(const Vec3&)>(in_a_point)}) {
        SweepProblem problem = good();
        set_level(problem, 2, move);
        CHECK(finding(problem).code == ErrorCode::target_degenerate);
        CHECK(finding(problem).ids == Error::Ids{2});
        problem = good();
        set_level(problem, 0, move);
        for (Vec3& x : problem.source_nodes) {
            x = move(x);
        }
        CHECK(finding(problem).code == ErrorCode::source_degenerate);
        CHECK(finding(problem).ids == Error::Ids{0});
    }
    // A loop folded onto itself: the second half runs back over the first.
    SweepProblem folded = grid_problem(straight());
    set_level(folded, 3, [](const Vec3& x) { return Vec3(x[0], x[0] * x[0], x[2]); });
    CHECK(finding(folded).code == ErrorCode::null_pseudo_area);
    CHECK(finding(folded).ids == Error::Ids{3});
}

TEST_CASE("neighbouring levels with opposite normals") {
    SweepProblem problem = good();
    set_level(problem, 2, [](const Vec3& x) { return Vec3(-x[0], x[1], x[2]); });
    CHECK(finding(problem).code == ErrorCode::orientation_reversed);
    CHECK(finding(problem).ids == Error::Ids{1, 2});
    // A half turn in small steps is a sweep.
    CHECK(verify_problem(grid_problem(
                             [](double x, double y, double t) {
                                 const double angle = 4.0 * t;
                                 return Vec3((3 + x) * std::cos(angle), y, (3 + x) * std::sin(angle));
                             },
                             {.layers = 8}))
              .empty());
}

TEST_CASE("extreme but sound scales pass") {
    for (const double scale : {1e-200, 1e-30, 1e30, 1e200}) {
        CHECK(verify_problem(moved(good(), [=](const Vec3& x) { return Vec3(x * scale); })).empty());
    }
}
