// Properties of whole sweeps.
#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/sweep.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr AffineMethod methods[] = {AffineMethod::constrained, AffineMethod::h, AffineMethod::g, AffineMethod::f};
constexpr SweepStrategy strategies[] = {SweepStrategy::direct, SweepStrategy::front};
constexpr BoundaryCorrection corrections[] = {BoundaryCorrection::idw, BoundaryCorrection::harmonic,
                                              BoundaryCorrection::none};

std::vector<Vec3> nodes_of(const SweepProblem& problem, const SweepOptions& options = {}) {
    const SweepResult result = sweep(problem, options);
    return {result.mesh.nodes().begin(), result.mesh.nodes().end()};
}

bool same_bytes(std::span<const Vec3> a, std::span<const Vec3> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

template <class Move>
double gap(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Move& move) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, (move(a[i]) - b[i]).norm());
    }
    return worst;
}
double gap(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return gap(a, b, [](const Vec3& x) { return x; });
}

template <class Body>
void for_all_options(const Body& body) {
    for (const auto method : methods) {
        for (const auto strategy : strategies) {
            for (const auto correction : corrections) {
                INFO(to_string(method) << " " << to_string(strategy) << " " << to_string(correction));
                SweepOptions options;
                options.method = method;
                options.strategy = strategy;
                options.correction = correction;
                body(options);
            }
        }
    }
}

const GridOptions holed{.cells = 6, .hole = 2, .layers = 4, .bump = 0.3};

// Loops in a given order, each started at another node or reversed; the levels follow.
SweepProblem rearranged(const SweepProblem& p, const std::vector<std::size_t>& order, std::size_t shift, bool reverse) {
    SweepProblem q = p;
    q.loops = {};
    std::vector<std::size_t> source;
    for (const std::size_t l : order) {
        const auto loop = p.loops[l];
        std::vector<std::size_t> at(loop.size());
        std::iota(at.begin(), at.end(), p.loops.offsets[l]);
        std::rotate(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(shift % at.size()), at.end());
        if (reverse) {
            std::reverse(at.begin(), at.end());
        }
        std::vector<Index> nodes;
        for (const std::size_t i : at) {
            nodes.push_back(p.loops.nodes[i]);
            source.push_back(i);
        }
        q.loops.add(nodes);
    }
    for (std::size_t k = 0; k <= p.layers; ++k) {
        for (std::size_t i = 0; i < source.size(); ++i) {
            q.boundary_levels[k * source.size() + i] = p.level(k)[source[i]];
        }
    }
    return q;
}

}  // namespace

TEST_CASE("rigid motions, reflections and scaling move the result along") {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const Eigen::Matrix3d mirror = Vec3(1, -1, 1).asDiagonal();
    const SweepProblem p = grid_problem(warped(), holed);
    for_all_options([&](const SweepOptions& options) {
        const std::vector<Vec3> nodes = nodes_of(p, options);
        const auto check = [&](const auto& move, double tolerance) {
            CHECK(gap(nodes, nodes_of(moved(p, move), options), move) < tolerance);
        };
        check([](const Vec3& x) { return Vec3(x + Vec3(3, -20, 7)); }, 1e-12);
        check([&](const Vec3& x) { return Vec3(turn * x); }, 1e-12);
        check([&](const Vec3& x) { return Vec3(mirror * turn * x); }, 1e-12);
        for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
            check([=](const Vec3& x) { return Vec3(scale * x); }, 1e-12 * scale);
        }
    });
}

TEST_CASE("order, first nodes and sense of the loops do not matter") {
    const SweepProblem p = grid_problem(warped(), holed);
    for_all_options([&](const SweepOptions& options) {
        const std::vector<Vec3> nodes = nodes_of(p, options);
        CHECK(gap(nodes, nodes_of(rearranged(p, {1, 0}, 0, false), options)) < 1e-12);
        CHECK(gap(nodes, nodes_of(rearranged(p, {0, 1}, 5, false), options)) < 1e-12);
        CHECK(gap(nodes, nodes_of(rearranged(p, {1, 0}, 3, true), options)) < 1e-12);
    });
    CHECK(sweep(rearranged(p, {0, 1}, 0, true)).report.find(SweepNotice::loops_reversed) != nullptr);
    CHECK(sweep(p).report.warnings.empty());
}

TEST_CASE("renumbering permutes the nodes exactly") {
    const SweepProblem p = grid_problem(warped(), holed);
    const std::size_t n = p.level_size();
    std::vector<Index> to(n);
    std::iota(to.begin(), to.end(), Index{0});
    std::shuffle(to.begin(), to.end(), std::mt19937(7));
    SweepProblem q = p;
    for (std::size_t i = 0; i < n; ++i) {
        q.source_nodes[to[i]] = p.source_nodes[i];
        q.target_nodes[to[i]] = p.target_nodes[i];
    }
    for (QuadCorners& quad : q.quads) {
        for (Index& i : quad) {
            i = to[i];
        }
    }
    for (Index& i : q.loops.nodes) {
        i = to[i];
    }
    for_all_options([&](const SweepOptions& options) {
        const std::vector<Vec3> a = nodes_of(p, options);
        const std::vector<Vec3> b = nodes_of(q, options);
        double worst = 0;
        for (std::size_t k = 0; k <= p.layers; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                worst = std::max(worst, (a[k * n + i] - b[k * n + to[i]]).norm());
            }
        }
        // The factorisation of the harmonic operator orders its unknowns anew.
        CHECK(worst <= (options.correction == BoundaryCorrection::harmonic ? 1e-14 : 0.0));
    });
}

TEST_CASE("source and target swapped: levels reversed") {
    const SweepProblem p = grid_problem(warped(), holed);
    SweepProblem q = rearranged(p, {0, 1}, 0, true);
    std::swap(q.source_nodes, q.target_nodes);
    const std::size_t m = p.loops.nodes.size();
    for (std::size_t k = 0; k <= p.layers; ++k) {
        for (std::size_t i = 0; i < m; ++i) {
            q.boundary_levels[k * m + i] = rearranged(p, {0, 1}, 0, true).level(p.layers - k)[i];
        }
    }
    for (QuadCorners& quad : q.quads) {
        std::reverse(quad.begin(), quad.end());
    }
    for_all_options([&](const SweepOptions& options) {
        const std::vector<Vec3> a = nodes_of(p, options);
        const std::vector<Vec3> b = nodes_of(q, options);
        double worst = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t k = i / p.level_size();
            worst = std::max(worst, (a[i] - b[(p.layers - k) * p.level_size() + i % p.level_size()]).norm());
        }
        CHECK(worst < 1e-12);
    });
}

TEST_CASE("levels in between leave the old ones where they are (direct)") {
    GridOptions few = holed;
    GridOptions many = holed;
    many.layers = 2 * few.layers;
    const SweepProblem p = grid_problem(warped(), few);
    const SweepProblem q = grid_problem(warped(), many);
    for_all_options([&](const SweepOptions& options) {
        if (options.strategy == SweepStrategy::direct) {
            const std::vector<Vec3> a = nodes_of(p, options);
            const std::vector<Vec3> b = nodes_of(q, options);
            const std::size_t n = p.level_size();
            for (std::size_t k = 0; k <= few.layers; ++k) {
                CHECK(same_bytes(std::span(a).subspan(k * n, n), std::span(b).subspan(2 * k * n, n)));
            }
        }
    });
}

TEST_CASE("planar affine loops: front is direct, the correction changes nothing, caps are carried rigidly") {
    const SweepProblem p = grid_problem(twisted(), holed);
    SweepOptions options;
    const std::vector<Vec3> nodes = nodes_of(p, options);
    for (const auto strategy : strategies) {
        for (const auto correction : corrections) {
            options.strategy = strategy;
            options.correction = correction;
            CHECK(gap(nodes, nodes_of(p, options)) < 1e-13);
        }
    }
}

TEST_CASE("the corrected sweep interpolates: an inner node near a loop node moves as that does") {
    // A node of the caps brought to 1e-7 of a loop node lands within about 1e-7 of that loop node at every level.
    SweepProblem p = grid_problem(warped(), {.cells = 6, .bump = 0});
    const Index loop_node = 3;
    const Index inner = 10;
    REQUIRE(p.loops.nodes[3] == loop_node);
    p.source_nodes[inner] = p.source_nodes[loop_node] + Vec3(0, 1e-7, 0);
    p.target_nodes[inner] = p.target_nodes[loop_node] + Vec3(0, 1e-7, 0);
    const std::vector<Vec3> nodes = nodes_of(p);
    for (std::size_t k = 0; k <= p.layers; ++k) {
        CHECK((nodes[k * p.level_size() + inner] - p.level(k)[3]).norm() < 1e-6);
    }
}

TEST_CASE("noise of eps moves the nodes by about 2 eps at most (constrained map)") {
    for (const auto& place : {twisted(), warped(), straight()}) {
        const SweepProblem p = grid_problem(place, {.cells = 8, .layers = 6});
        for (const auto correction : corrections) {
            SweepOptions options;
            options.correction = correction;
            const std::vector<Vec3> clean = nodes_of(p, options);
            for (const double eps : {1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
                options.verify.boundary_tolerance = 1;
                for (unsigned seed = 0; seed < 3; ++seed) {
                    const std::vector<Vec3> shaken = nodes_of(noisy(p, eps, seed), options);
                    CHECK(gap(clean, shaken) < 2 * std::sqrt(3.0) * eps + 1e-14);
                }
            }
        }
    }
}

TEST_CASE("threads change no bit") {
    const SweepProblem p = grid_problem(warped(), {.cells = 40, .layers = 5});
    for_all_options([&](SweepOptions options) {
        const std::vector<Vec3> one = nodes_of(p, options);
        options.execution = {3};
        CHECK(same_bytes(one, nodes_of(p, options)));
    });
}

TEST_CASE("one layer needs no map: any loops that verify will do") {
    const SweepProblem p = grid_problem(warped(), {.layers = 1});
    for_all_options([&](const SweepOptions& options) {
        const SweepResult result = sweep(p, options);
        CHECK(same_bytes(result.mesh.level(0), p.source_nodes));
        CHECK(same_bytes(result.mesh.level(1), p.target_nodes));
        CHECK(result.report.residuals.empty());
    });
}

TEST_CASE("meshes are conforming, positive and have the volume of their boundary") {
    for (const auto& place : {straight(), twisted(), warped()}) {
        for (const Index hole : {0U, 2U}) {
            for (const auto strategy : strategies) {
                for (const auto correction : corrections) {
                    SweepOptions options;
                    options.strategy = strategy;
                    options.correction = correction;
                    const SweepResult result =
                        sweep(grid_problem(place, {.cells = 8, .hole = hole, .layers = 6, .bump = 0.15}), options);
                    const auto report = verify_hexes(result.mesh);
                    INFO(report.text());
                    CHECK(report.ok());
                    CHECK(result.report.hexahedra == result.mesh.hex_count());
                    CHECK(result.report.nodes == result.mesh.nodes().size());
                }
            }
        }
    }
}

TEST_CASE("extreme scales give the same shape") {
    const SweepProblem p = grid_problem(warped(), holed);
    for_all_options([&](const SweepOptions& options) {
        const std::vector<Vec3> nodes = nodes_of(p, options);
        for (const double scale : {0x1p-600, 0x1p600}) {
            const std::vector<Vec3> scaled =
                nodes_of(moved(p, [=](const Vec3& x) { return Vec3(x * scale); }), options);
            CHECK(gap(scaled, nodes, [=](const Vec3& x) { return Vec3(x / scale); }) < 1e-12);
        }
    });
}
