#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include "smooth/meshes.hpp"
#include "smooth/solid_meshes.hpp"
#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

using namespace pavior;
using namespace pavior_test;

namespace {

SmoothReport improve(HexGrid& grid, const ImproveOptions& options = {}) {
    return improve_hexes(grid.nodes, grid.hexes, FixedNodes{grid.fixed}, options);
}

// A ball; the nodes of its surface slide on the sphere of radius 3 about `centre`.
struct Ball {
    HexGrid grid;
    std::vector<Freedom> freedoms;
    Vec3 centre{10, -5, 2};

    explicit Ball(Index n) : grid(hex_grid(n, n, n)) {
        for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
            const Vec3 x = 2.0 / n * grid.nodes[i] - Vec3::Ones();
            const double rim = x.lpNorm<Eigen::Infinity>();
            grid.nodes[i] = centre + 3.0 * (0.5 * (1.0 - rim * rim) * x + rim * rim * x.stableNormalized());
            freedoms.push_back(grid.fixed[i] != 0 ? Freedom::surface : Freedom::space);
            if (grid.fixed[i] != 0) {
                grid.nodes[i] = project(grid.nodes[i]);
            }
        }
    }
    [[nodiscard]] Vec3 project(const Vec3& x) const { return centre + 3.0 * (x - centre).normalized(); }
    [[nodiscard]] auto guide() const {
        return GuidedNodes{freedoms, [this](Index, const Vec3& x) { return project(x); }, true};
    }
};

// A cylinder of radius 2 and height 3: its wall, its two caps (planes) and their rims (circles).
struct Cylinder {
    HexGrid grid;
    std::vector<Freedom> freedoms;
    Index level_size = 0;
    Index layers = 0;

    Cylinder(Index n, Index rings, Index layer_count) : layers(layer_count) {
        const QuadGrid cap = disc(n, rings);
        level_size = static_cast<Index>(cap.nodes.size());
        for (Index k = 0; k <= layers; ++k) {
            for (Index i = 0; i < level_size; ++i) {
                const Vec2 p = 2.0 * cap.nodes[i];
                grid.nodes.push_back({p.x(), p.y(), 3.0 * k / layers});
                const bool wall = cap.fixed[i] != 0;
                const bool end = k == 0 || k == layers;
                freedoms.push_back(wall && end ? Freedom::curve : wall || end ? Freedom::surface : Freedom::space);
                grid.fixed.push_back(0);
            }
            for (const QuadCorners& q : cap.quads) {
                const Index a = k * level_size;
                const Index b = a + level_size;
                if (k < layers) {
                    grid.hexes.push_back(
                        {q[0] + a, q[1] + a, q[2] + a, q[3] + a, q[0] + b, q[1] + b, q[2] + b, q[3] + b});
                }
            }
        }
    }
    [[nodiscard]] bool on_end(Index i) const { return i < level_size || i >= level_size * layers; }
    [[nodiscard]] bool on_wall(Index i) const {
        return freedoms[i] == Freedom::curve || (freedoms[i] == Freedom::surface && !on_end(i));
    }
    [[nodiscard]] Vec3 project(Index i, const Vec3& x) const {
        Vec3 y = x;
        if (on_end(i)) {
            y.z() = i < level_size ? 0.0 : 3.0;
        }
        if (on_wall(i)) {
            y.head<2>() = 2.0 * x.head<2>().normalized();
        }
        return y;
    }
};

// Moves every node, and brings those that slide back.
template <class Guide>
void shake_guided(HexGrid& grid, const Guide& guide, double amount, unsigned seed) {
    Random random(seed);
    for (Index i = 0; i < grid.nodes.size(); ++i) {
        const Vec3 step(random(-amount, amount), random(-amount, amount), random(-amount, amount));
        const Freedom freedom = guide.freedom(i);
        if (freedom != Freedom::fixed) {
            const Vec3 x = grid.nodes[i] + step;
            grid.nodes[i] = freedom == Freedom::space ? x : guide.project(i, x);
        }
    }
}

struct MinimalGuide {  // the least that a guide may be: no copy, no default, two members
    explicit MinimalGuide(const std::vector<std::uint8_t>& fixed) : fixed_(fixed) {}
    MinimalGuide(const MinimalGuide&) = delete;
    MinimalGuide& operator=(const MinimalGuide&) = delete;
    [[nodiscard]] Freedom freedom(Index i) const { return fixed_[i] != 0 ? Freedom::fixed : Freedom::space; }
    [[nodiscard]] const Vec3& project(Index, const Vec3& x) const { return x; }

private:
    const std::vector<std::uint8_t>& fixed_;
};

}  // namespace

TEST_CASE("a mesh as good as wanted is only looked at", "[improve_hexes]") {
    HexGrid grid = hex_grid(6, 6, 6);
    const HexGrid perfect = grid;
    CHECK(improve(grid).status == SmoothStatus::unchanged);
    CHECK(grid.nodes == perfect.nodes);
    shake(grid, 0.1, 3);
    const HexGrid before = grid;
    ImproveOptions options;
    options.target = 0.9 * least(grid);
    const SmoothReport report = improve(grid, options);
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.iterations == 0);
    CHECK(report.moved_nodes == 0);
    CHECK(report.min_det_before == report.min_det_after);
    CHECK(grid.nodes == before.nodes);
}

TEST_CASE("what is inverted is repaired however low the target", "[improve_hexes]") {
    HexGrid grid = hex_grid(4, 4, 4);
    const Index inner = 2 + 5 * 2 + 25 * 2;
    while (least(grid) > 0.0) {
        grid.nodes[inner] += Vec3(0.02, 0.02, 0.02);
    }
    ImproveOptions options;
    options.target = 0.1;
    options.gain = 0.5;
    REQUIRE(least(grid) > options.target - options.gain);
    const SmoothReport report = improve(grid, options);
    CHECK(report.inverted_before > 0);
    CHECK(report.status == SmoothStatus::repaired);
}

TEST_CASE("work ends at the target and stays near the worst", "[improve_hexes]") {
    HexGrid grid = hex_grid(14, 14, 14);
    const HexGrid perfect = grid;
    const Index centre = 7 + 15 * 7 + 15 * 15 * 7;
    grid.nodes[centre] += Vec3(0.3, 0.35, 0.3);
    ImproveOptions options;
    options.target = 0.8;
    REQUIRE(least(grid) < 0.6);
    const SmoothReport report = improve(grid, options);
    CHECK(report.status == SmoothStatus::improved);
    CHECK(report.min_det_after >= 0.8 - options.gain);
    CHECK(report.moved_nodes <= 27);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const double distance = (perfect.nodes[i] - perfect.nodes[centre]).lpNorm<Eigen::Infinity>();
        CHECK((distance < 1.5 || grid.nodes[i] == perfect.nodes[i]));
    }
}

TEST_CASE("never worse than the input", "[improve_hexes]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        HexGrid grid = hex_grid(2 + seed % 4, 2 + seed % 3, 3);
        Eigen::Matrix3d map;
        for (Eigen::Index k = 0; k < 9; ++k) {
            map(k) = random(-1.0, 1.0) + (k % 4 == 0 ? 1.5 : 0.0);
        }
        for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
            grid.nodes[i] = map * grid.nodes[i];
            grid.fixed[i] = random(0.0, 1.0) < (grid.fixed[i] != 0 ? 0.8 : 0.2) ? 1 : 0;
        }
        shake(grid, random(0.0, seed % 2 == 0 ? 0.2 : 0.8), seed);
        const HexGrid before = grid;
        const std::vector<double> old = sorted_quality(before);
        ImproveOptions options;
        options.sufficient = random(0.0, 1.0);
        options.rings = 1 + static_cast<int>(seed % 3);
        const SmoothReport report = improve(grid, options);
        const std::vector<double> now = sorted_quality(grid);
        const auto inverted = [](const std::vector<double>& all) {
            return std::count_if(all.begin(), all.end(), [](double q) { return q <= 1e-12; });
        };
        CHECK(now.front() >= old.front() - 1e-14);
        CHECK(inverted(now) <= inverted(old));
        CHECK(report.inverted_before == static_cast<std::size_t>(inverted(old)));
        CHECK(report.inverted_after == static_cast<std::size_t>(inverted(now)));
        CHECK(report.inverted_ids.size() == report.inverted_after);
        if (inverted(old) == 0) {
            const auto round = [](std::vector<double> all) {
                std::transform(all.begin(), all.end(), all.begin(), [](double q) { return std::round(q * 1e10); });
                return all;
            };
            const std::vector<double> a = round(old);
            const std::vector<double> b = round(now);
            CHECK_FALSE(std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end()));
        }
        CHECK(fixed_kept(before, grid));
    }
}

TEST_CASE("nodes slide on a sphere and stay on it", "[improve_hexes]") {
    Ball ball(6);
    const double original = least(ball.grid);
    REQUIRE(original > 0.0);
    shake_guided(ball.grid, ball.guide(), 0.35, 4);
    const double shaken = least(ball.grid);
    REQUIRE(shaken < 0.0);
    HexGrid fixed_surface = ball.grid;
    const SmoothReport report = improve_hexes(ball.grid.nodes, ball.grid.hexes, ball.guide());
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(least(ball.grid) >= 0.95 * original);
    double off = 0.0;
    for (std::size_t i = 0; i < ball.grid.nodes.size(); ++i) {
        off = ball.freedoms[i] == Freedom::surface
                  ? std::max(off, std::abs((ball.grid.nodes[i] - ball.centre).norm() - 3.0))
                  : off;
    }
    CHECK(off < 1e-14 * 30);
    improve(fixed_surface);
    CHECK(least(fixed_surface) < 0.5 * least(ball.grid));
}

TEST_CASE("nodes slide on walls, rims and caps of a cylinder", "[improve_hexes]") {
    Cylinder cylinder(4, 3, 6);
    const auto project = [&](Index i, const Vec3& x) { return cylinder.project(i, x); };
    const GuidedNodes guide{cylinder.freedoms, project};
    const double original = least(cylinder.grid);
    shake_guided(cylinder.grid, guide, 0.22, 8);
    REQUIRE(count_inverted(cylinder.grid.nodes, cylinder.grid.hexes, 1) > 20);
    const SmoothReport report = improve_hexes(cylinder.grid.nodes, cylinder.grid.hexes, guide);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(count_inverted(cylinder.grid.nodes, cylinder.grid.hexes, 1) == 0);
    CHECK(least(cylinder.grid) >= 0.95 * original);
    for (Index i = 0; i < cylinder.grid.nodes.size(); ++i) {
        const Vec3& x = cylinder.grid.nodes[i];
        CHECK((!cylinder.on_wall(i) || std::abs(x.head<2>().norm() - 2.0) < 1e-14));
        CHECK((!cylinder.on_end(i) || x.z() == (i < cylinder.level_size ? 0.0 : 3.0)));
    }
}

TEST_CASE("a boundary folded in its plane is unfolded by sliding", "[improve_hexes]") {
    HexGrid grid = hex_grid(5, 5, 5);
    std::vector<Freedom> freedoms;
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const bool top_inside = grid.nodes[i].z() == 5.0 && grid.nodes[i].x() * grid.nodes[i].y() > 0.0 &&
                                grid.nodes[i].head<2>().maxCoeff() < 5.0;
        freedoms.push_back(grid.fixed[i] == 0 ? Freedom::space : top_inside ? Freedom::surface : Freedom::fixed);
    }
    grid.nodes[2 + 6 * 2 + 36 * 5] += Vec3(1.7, 0.3, 0.0);
    const HexGrid before = grid;
    const GuidedNodes guide{freedoms, [](Index, const Vec3& x) { return Vec3(x.x(), x.y(), 5.0); }};
    const SmoothReport report = improve_hexes(grid.nodes, grid.hexes, guide);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(report.min_det_after > 0.95);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK((freedoms[i] != Freedom::fixed || grid.nodes[i] == before.nodes[i]));
        CHECK((freedoms[i] != Freedom::surface || grid.nodes[i].z() == 5.0));
    }
    HexGrid stuck = before;
    CHECK(improve(stuck).status == SmoothStatus::still_inverted);
}

TEST_CASE("a guide that refuses leaves its nodes where they are", "[improve_hexes]") {
    HexGrid grid = hex_grid(4, 4, 4);
    shake(grid, 0.3, 5);
    const HexGrid before = grid;
    std::vector<Freedom> freedoms;
    for (const std::uint8_t fixed : grid.fixed) {
        freedoms.push_back(fixed != 0 ? Freedom::surface : Freedom::space);
    }
    const GuidedNodes guide{freedoms, [](Index, const Vec3&) { return Vec3(NAN, 0, 0); }};
    const SmoothReport report = improve_hexes(grid.nodes, grid.hexes, guide);
    CHECK(report.min_det_after > 0.9);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK((freedoms[i] != Freedom::surface || (grid.nodes[i] - before.nodes[i]).norm() < 1e-12));
    }
}

TEST_CASE("an exception of the guide leaves the mesh as it was", "[improve_hexes]") {
    Cylinder cylinder(3, 2, 4);
    int calls = 0;
    const GuidedNodes guide{cylinder.freedoms, [&](Index i, const Vec3& x) {
                                if (++calls > 5000) {
                                    throw std::runtime_error("no more");
                                }
                                return cylinder.project(i, x);
                            }};
    shake_guided(cylinder.grid, guide, 0.3, 8);
    const HexGrid before = cylinder.grid;
    CHECK_THROWS_AS(improve_hexes(cylinder.grid.nodes, cylinder.grid.hexes, guide), std::runtime_error);
    CHECK(cylinder.grid.nodes == before.nodes);
}

TEST_CASE("improve_hexes: same bytes for any number of threads", "[improve_hexes]") {
    HexGrid one = hex_grid(11, 11, 11);
    shake(one, 0.32, 2);
    const HexGrid before = one;
    ImproveOptions options;
    options.target = 0.6;
    const SmoothReport a = improve(one, options);
    CHECK(a.status == SmoothStatus::repaired);
    Ball ball(6);
    shake_guided(ball.grid, ball.guide(), 0.3, 4);
    const Ball shaken = ball;
    improve_hexes(ball.grid.nodes, ball.grid.hexes, ball.guide());
    for (const unsigned threads : {2U, 5U}) {
        CAPTURE(threads);
        options.execution = Execution{threads};
        HexGrid other = before;
        const SmoothReport b = improve(other, options);
        CHECK(a.iterations == b.iterations);
        CHECK(a.moved_nodes == b.moved_nodes);
        CHECK(one.nodes == other.nodes);
        Ball again = shaken;
        ImproveOptions threaded;
        threaded.execution = Execution{threads};
        improve_hexes(again.grid.nodes, again.grid.hexes, again.guide(), threaded);
        CHECK(ball.grid.nodes == again.grid.nodes);
    }
}

TEST_CASE("improve_hexes: scale and position do not matter", "[improve_hexes]") {
    HexGrid base = twisted_sweep(4, 8);
    shake(base, 0.15, 7);
    HexGrid plain = base;
    const SmoothReport report = improve(plain);
    for (const double scale : {1e-6, 1e6, 1e-100, 1e100}) {
        CAPTURE(scale);
        HexGrid grid = base;
        for (Vec3& x : grid.nodes) {
            x = scale * (x + Vec3(100, -200, 300));
        }
        const SmoothReport other = improve(grid);
        CHECK(other.status == report.status);
        CHECK(other.inverted_before == report.inverted_before);
        CHECK(other.min_det_after == Approx(report.min_det_after).margin(0.01));
    }
}

TEST_CASE("thin layers stay thin", "[improve_hexes]") {
    HexGrid grid = hex_grid(6, 6, 8);
    for (Vec3& x : grid.nodes) {
        x.z() *= 0.02;
    }
    const HexGrid thin = grid;
    Random random(3);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        if (grid.fixed[i] == 0) {
            grid.nodes[i] += Vec3(random(-0.25, 0.25), random(-0.25, 0.25), random(-0.005, 0.005));
        }
    }
    REQUIRE(count_inverted(grid.nodes, grid.hexes) == 0);
    const SmoothReport report = improve(grid);
    CHECK(report.min_det_after > 0.95);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK(std::abs(grid.nodes[i].z() - thin.nodes[i].z()) < 0.02);
    }
}

TEST_CASE("a reference helps thin layers that are inverted", "[improve_hexes]") {
    HexGrid grid = hex_grid(6, 6, 8);
    for (Vec3& x : grid.nodes) {
        x.z() *= 0.02;
    }
    const HexGrid thin = grid;
    Random random(3);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        grid.nodes[i].z() += grid.fixed[i] == 0 ? random(-0.05, 0.05) : 0.0;
    }
    const SmoothReport report = improve_hexes(grid.nodes, grid.hexes, FixedNodes{grid.fixed}, {}, thin.nodes);
    CHECK(report.inverted_before > 50);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(report.min_det_after > 0.95);
}

TEST_CASE("with positivity sampled the quality is that of 27 points", "[improve_hexes]") {
    HexGrid grid = hex_grid(5, 5, 5);
    shake(grid, 0.5, 6);
    ImproveOptions options;
    options.positivity = HexPositivity::sampled;
    options.target = 0.5;
    const SmoothReport report = improve(grid, options);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(report.min_det_after >= 0.49);
    CHECK(count_inverted(grid.nodes, grid.hexes, 2) == 0);
}

TEST_CASE("hexahedra that fixed nodes spoil do not stop the others", "[improve_hexes]") {
    HexGrid grid = hex_grid(7, 7, 7);
    grid.nodes[0] = Vec3(1.2, 0.9, 0.9);  // inverts the first hexahedron for good
    shake(grid, 0.5, 9);
    const HexGrid before = grid;
    const SmoothReport report = improve(grid);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_ids == std::vector<Index>{0});
    CHECK(fixed_kept(before, grid));
    CHECK(sorted_quality(grid)[7] >= 0.3);
}

TEST_CASE("effort bounds the work", "[improve_hexes]") {
    HexGrid grid = hex_grid(11, 11, 11);
    shake(grid, 0.15, 9);
    HexGrid copy = grid;
    const SmoothReport full = improve(grid);
    ImproveOptions options;
    options.effort = 1e-3;  // one round
    const SmoothReport brief = improve(copy, options);
    CHECK(full.min_det_after > 0.95);
    CHECK(2 * brief.iterations < full.iterations);
    CHECK(brief.min_det_after > brief.min_det_before);
    CHECK(brief.min_det_after < full.min_det_after);
}

TEST_CASE("improve_hexes reads a foreign mesh and an archetype", "[improve_hexes]") {
    HexGrid grid = hex_grid(4, 4, 4);
    shake(grid, 0.45, 3);
    for (Vec3& x : grid.nodes) {
        x = x.cast<float>().cast<double>();
    }
    HexGrid copy = grid;
    const SmoothReport expected = improve(copy);
    CHECK(expected.status == SmoothStatus::repaired);

    const archetype::Hexes minimal(HexMesh{grid.nodes, grid.hexes});
    const ImprovedHexes result = improve_hexes(minimal, MinimalGuide(grid.fixed));
    CHECK(result.nodes == copy.nodes);
    CHECK(result.report.iterations == expected.iterations);
    CHECK(minimal.get().nodes == grid.nodes);

    std::vector<std::array<float, 3>> points;
    std::vector<std::array<long, 8>> cells;
    for (const Vec3& x : grid.nodes) {
        points.push_back({static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())});
    }
    for (const HexCorners& h : grid.hexes) {
        cells.emplace_back();
        std::copy(h.begin(), h.end(), cells.back().begin());
    }
    const HexMeshView<std::array<float, 3>, std::array<long, 8>> view{points, cells};
    CHECK(improve_hexes(view, FixedNodes{grid.fixed}).nodes == copy.nodes);
}

TEST_CASE("a guide of another number of nodes than the mesh is refused", "[improve_hexes]") {
    HexGrid grid = hex_grid(2, 2, 2);
    shake(grid, 0.3, 1);
    const auto code_of = [&](const auto& guide) {
        const HexGrid before = grid;
        try {
            improve_hexes(grid.nodes, grid.hexes, guide);
        } catch (const InputError& error) {
            CHECK(grid.nodes == before.nodes);
            return error.code();
        }
        return ErrorCode::unreadable_file;
    };
    const std::span<const std::uint8_t> flags(grid.fixed);
    CHECK(code_of(FixedNodes{flags.first(26)}) == ErrorCode::size_mismatch);
    CHECK(code_of(FixedNodes{}) == ErrorCode::size_mismatch);
    const std::vector<Freedom> freedoms(28, Freedom::fixed);
    const auto stay = [](Index, const Vec3& x) { return x; };
    CHECK(code_of(GuidedNodes{std::span<const Freedom>(freedoms), stay}) == ErrorCode::size_mismatch);
    CHECK(code_of(GuidedNodes{std::span<const Freedom>(freedoms).first(27), stay}) == ErrorCode::unreadable_file);
    const HexMeshView view{grid.nodes, grid.hexes};
    CHECK_THROWS_AS(improve_hexes(view, FixedNodes{flags.first(3)}), InputError);
}

TEST_CASE("improve_hexes: callers' mistakes", "[improve_hexes]") {
    const HexGrid grid = hex_grid(2, 2, 2);
    const auto code_of = [](HexGrid given, const ImproveOptions& options = {}, std::vector<Vec3> reference = {}) {
        const HexGrid before = given;
        try {
            improve_hexes(given.nodes, given.hexes, FixedNodes{given.fixed}, options, reference);
        } catch (const InputError& error) {
            CHECK(std::equal(given.nodes.begin(), given.nodes.end(), before.nodes.begin(),
                             [](const Vec3& a, const Vec3& b) { return a == b || !a.allFinite(); }));
            return error.code();
        }
        return ErrorCode::unreadable_file;
    };
    HexGrid bad = grid;
    bad.hexes[7][0] = 27;
    CHECK(code_of(bad) == ErrorCode::bad_index);
    bad = grid;
    bad.hexes[7][0] = bad.hexes[7][1];
    CHECK(code_of(bad) == ErrorCode::bad_index);
    bad = grid;
    bad.nodes[13].z() = NAN;
    CHECK(code_of(bad) == ErrorCode::not_finite);
    CHECK(code_of(grid, {}, std::vector<Vec3>(5, Vec3::Zero())) == ErrorCode::size_mismatch);
    CHECK(code_of(grid, {}, std::vector<Vec3>(27, Vec3::Constant(NAN))) == ErrorCode::not_finite);
    const auto refused = [&](auto spoil) {
        ImproveOptions options;
        spoil(options);
        return code_of(grid, options) == ErrorCode::bad_option;
    };
    CHECK(refused([](ImproveOptions& o) { o.target = 0.0; }));
    CHECK(refused([](ImproveOptions& o) { o.target = 1.1; }));
    CHECK(refused([](ImproveOptions& o) { o.target = NAN; }));
    CHECK(refused([](ImproveOptions& o) { o.sufficient = -0.1; }));
    CHECK(refused([](ImproveOptions& o) { o.sufficient = NAN; }));
    CHECK(refused([](ImproveOptions& o) { o.gain = 0.0; }));
    CHECK(refused([](ImproveOptions& o) { o.gain = 0.6; }));
    CHECK(refused([](ImproveOptions& o) { o.rings = 0; }));
    CHECK(refused([](ImproveOptions& o) { o.rings = 1001; }));
    CHECK(refused([](ImproveOptions& o) { o.attempts = 0; }));
    CHECK(refused([](ImproveOptions& o) { o.effort = 0.0; }));
    CHECK(refused([](ImproveOptions& o) { o.effort = NAN; }));
}

TEST_CASE("improve_hexes: nothing to work on", "[improve_hexes]") {
    HexGrid empty;
    const SmoothReport report = improve(empty);
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.min_det_after == 1.0);
    HexGrid rigid = hex_grid(1, 1, 2);
    rigid.nodes[4] += Vec3(0.3, 0.2, 0.1);
    const HexGrid before = rigid;
    CHECK(improve(rigid).status == SmoothStatus::unchanged);
    CHECK(rigid.nodes == before.nodes);
}

TEST_CASE("improve_hexes: progress rises from 0 to 1", "[improve_hexes]") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        HexGrid grid = hex_grid(5, 5, 5);
        shake(grid, 0.3 + 0.2 * seed, seed);
        std::vector<double> fractions;
        ImproveOptions options;
        options.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
        improve(grid, options);
        REQUIRE(fractions.size() > 2);
        CHECK(fractions.front() == 0.0);
        CHECK(fractions.back() == 1.0);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    }
}

TEST_CASE("improve_hexes: a stop at any stage leaves the mesh as it was", "[improve_hexes]") {
    HexGrid grid = hex_grid(6, 6, 6);
    shake(grid, 0.6, 4);
    const HexGrid before = grid;
    std::size_t reports = 0;
    ImproveOptions options;
    options.progress = [&](std::string_view, double) { ++reports; };
    improve(grid, options);
    CHECK(grid.nodes != before.nodes);
    const std::size_t all = reports;
    REQUIRE(all > 4);
    for (const unsigned threads : {1U, 3U}) {
        for (std::size_t at = 1; at < all; at += 1 + all / 10) {
            CAPTURE(at, threads);
            std::stop_source source;
            options.execution = {threads, source.get_token()};
            reports = 0;
            options.progress = [&](std::string_view, double) {
                if (++reports == at) {
                    source.request_stop();
                }
            };
            grid = before;
            CHECK_THROWS_AS(improve(grid, options), Stopped);
            CHECK(grid.nodes == before.nodes);
        }
    }
}
