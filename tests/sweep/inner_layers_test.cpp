#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/verify_quads.hpp>
#include <pavior/mesh/verify_report.hpp>
#include <pavior/sweep/inner_layers.hpp>

#include <algorithm>
#include <cstring>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr BoundaryCorrection corrections[] = {BoundaryCorrection::idw, BoundaryCorrection::harmonic,
                                              BoundaryCorrection::none};

InnerLayers layers_of(const SweepProblem& problem, BoundaryCorrection correction) {
    return {problem, make_level_maps(problem), correction};
}

std::vector<Vec3> all(const InnerLayers& layers, Execution execution = {}) {
    std::vector<Vec3> nodes(layers.level_count() * layers.level_size());
    layers.all_levels(nodes, execution);
    return nodes;
}

bool same_bytes(std::span<const Vec3> a, std::span<const Vec3> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace

TEST_CASE("equation (4.9): both maps with their interpolated residuals, weighted") {
    const SweepProblem p = grid_problem(warped(), {.cells = 6, .hole = 2, .layers = 5});
    const std::vector<LevelMap> maps = make_level_maps(p);
    const std::vector<Vec3> nodes = all(layers_of(p, BoundaryCorrection::idw));
    const InverseDistanceError source(p.source_nodes, p.loops.nodes);
    const InverseDistanceError target(p.target_nodes, p.loops.nodes);
    for (std::size_t k = 1; k < p.layers; ++k) {
        const LevelMap& map = maps[k - 1];
        for (std::size_t j = 0; j < p.level_size(); ++j) {
            if (std::find(p.loops.nodes.begin(), p.loops.nodes.end(), j) != p.loops.nodes.end()) {
                continue;
            }
            Vec3 z0 = map.from_source(p.source_nodes[j]);
            Vec3 zr = map.from_target(p.target_nodes[j]);
            const auto w0 = source.weights(j);
            const auto wr = target.weights(j);
            for (std::size_t i = 0; i < p.loops.nodes.size(); ++i) {
                z0 += w0[i] * (p.level(k)[i] - map.from_source(p.level(0)[i]));
                zr += wr[i] * (p.level(k)[i] - map.from_target(p.level(p.layers)[i]));
            }
            const double t = static_cast<double>(k) / static_cast<double>(p.layers);
            CHECK((nodes[k * p.level_size() + j] - ((1 - t) * z0 + t * zr)).norm() < 1e-13);
        }
    }
}

TEST_CASE("caps and boundary nodes are those given, bit for bit") {
    const SweepProblem p = grid_problem(warped(), {.cells = 6, .hole = 2, .layers = 5});
    for (const auto correction : corrections) {
        const std::vector<Vec3> nodes = all(layers_of(p, correction));
        const std::size_t n = p.level_size();
        CHECK(same_bytes(std::span(nodes).first(n), p.source_nodes));
        CHECK(same_bytes(std::span(nodes).last(n), p.target_nodes));
        for (std::size_t k = 1; k < p.layers; ++k) {
            for (std::size_t i = 0; i < p.loops.nodes.size(); ++i) {
                CHECK(nodes[k * n + p.loops.nodes[i]] == p.level(k)[i]);
            }
        }
    }
}

TEST_CASE("one level, the stream and the array are the same bytes for any number of threads") {
    // More than one block of nodes and more than one group of levels.
    const SweepProblem p = grid_problem(warped(), {.cells = 36, .layers = 70});
    for (const auto correction : corrections) {
        const InnerLayers layers = layers_of(p, correction);
        const std::size_t n = layers.level_size();
        const std::vector<Vec3> nodes = all(layers);
        CHECK(same_bytes(all(layers, {3}), nodes));
        std::size_t next = 0;
        layers.for_each_level(
            [&](std::size_t k, std::span<const Vec3> level) {
                CHECK(k == next++);
                CHECK(same_bytes(level, std::span(nodes).subspan(k * n, n)));
            },
            {2});
        CHECK(next == 71);
        std::vector<Vec3> level(n);
        for (const std::size_t k : {69U, 0U, 33U, 70U, 1U}) {
            layers.level(k, level, {2});
            CHECK(same_bytes(level, std::span(nodes).subspan(k * n, n)));
        }
    }
}

TEST_CASE("an array beyond the caches is the same, wherever it starts") {
    const SweepProblem p = grid_problem(twisted(), {.cells = 70, .layers = 300});
    const InnerLayers layers = layers_of(p, BoundaryCorrection::idw);
    const std::size_t n = layers.level_size();
    std::vector<Vec3> nodes(n * layers.level_count() + 1);
    const auto shifted = std::span(nodes).subspan(1);
    REQUIRE(shifted.size_bytes() > (std::size_t{32} << 20));
    layers.all_levels(shifted, {2});
    std::vector<Vec3> level(n);
    for (std::size_t k = 0; k <= 300; k += 17) {
        layers.level(k, level);
        CHECK(same_bytes(level, shifted.subspan(k * n, n)));
    }
}

TEST_CASE("moving one inner level does not change the others by a bit") {
    const SweepProblem p = grid_problem(warped(), {.layers = 6});
    SweepProblem other = p;
    const std::size_t m = p.loops.nodes.size();
    for (std::size_t i = 0; i < m; ++i) {
        other.boundary_levels[3 * m + i] += 0.1 * Vec3(1, p.level(3)[i][0] * p.level(3)[i][1], 0.5);
    }
    for (const auto correction : corrections) {
        const std::vector<Vec3> a = all(layers_of(p, correction));
        const std::vector<Vec3> b = all(layers_of(other, correction));
        const std::size_t n = p.level_size();
        for (std::size_t k = 0; k <= 6; ++k) {
            CHECK(same_bytes(std::span(a).subspan(k * n, n), std::span(b).subspan(k * n, n)) == (k != 3));
        }
    }
}

TEST_CASE("one layer: the two caps") {
    const SweepProblem p = grid_problem(warped(), {.layers = 1});
    const std::vector<Vec3> nodes = all(layers_of(p, BoundaryCorrection::harmonic));
    CHECK(same_bytes(std::span(nodes).first(p.level_size()), p.source_nodes));
    CHECK(same_bytes(std::span(nodes).last(p.level_size()), p.target_nodes));
}

TEST_CASE("wrong arguments are refused, progress ends at 1") {
    const InnerLayers layers = layers_of(grid_problem(straight()), BoundaryCorrection::none);
    std::vector<Vec3> level(layers.level_size());
    CHECK_THROWS_AS(layers.level(5, level), InputError);
    level.pop_back();
    CHECK_THROWS_AS(layers.level(1, level), InputError);
    CHECK_THROWS_AS(layers.all_levels(level), InputError);
    double done = 0;
    layers.for_each_level([](std::size_t, std::span<const Vec3>) {}, {},
                          [&](std::string_view, double fraction) {
                              CHECK(fraction >= done);
                              done = fraction;
                          });
    CHECK(done == 1);
}
