#include "support/catch.hpp"

#include <pavior/sweep/problem.hpp>

#include <array>
#include <vector>

using namespace pavior;

namespace {
const QuadMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}};

std::vector<std::vector<Vec3>> prism(std::size_t layers) {
    std::vector<std::vector<Vec3>> levels;
    for (std::size_t k = 0; k <= layers; ++k) {
        levels.push_back(square.nodes);
        for (Vec3& x : levels.back()) {
            x[2] = static_cast<double>(k);
        }
    }
    return levels;
}
}  // namespace

TEST_CASE("a problem holds copies of what it is made of") {
    const auto levels = prism(3);
    const SweepProblem problem = make_sweep_problem(square, levels.back(), levels);
    CHECK(problem.source_nodes == square.nodes);
    CHECK(problem.target_nodes == levels.back());
    CHECK(problem.quads == square.quads);
    CHECK(problem.loops == boundary_loops(square));
    CHECK(problem.layers == 3);
    CHECK(problem.level_size() == 4);
    for (std::size_t k = 0; k <= 3; ++k) {
        REQUIRE(problem.level(k).size() == 4);
        CHECK(problem.level(k)[2] == Vec3(1, 1, static_cast<double>(k)));
    }
}

TEST_CASE("arrays of any point type will do") {
    const std::vector<std::array<float, 3>> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<std::array<int, 4>> quads{{0, 1, 2, 3}};
    const QuadMeshView<std::array<float, 3>, std::array<int, 4>> source{nodes, quads};
    std::vector<std::array<float, 3>> points = nodes;
    points.insert(points.end(), nodes.begin(), nodes.end());
    const LevelArray<std::array<float, 3>> levels{points, 4};
    const SweepProblem problem = make_sweep_problem(source, nodes, levels);
    CHECK(problem.source_nodes == square.nodes);
    CHECK(problem.layers == 1);
}

TEST_CASE("a level of the wrong length is named") {
    auto levels = prism(4);
    levels[2].pop_back();
    try {
        static_cast<void>(make_sweep_problem(square, square.nodes, levels));
        FAIL("accepted");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::size_mismatch);
        CHECK(error.ids() == Error::Ids{2});
    }
}

TEST_CASE("no levels are no layers") {
    CHECK(make_sweep_problem(square, square.nodes, prism(0)).layers == 0);
    CHECK(make_sweep_problem(square, square.nodes, std::vector<std::vector<Vec3>>{}).layers == 0);
}
