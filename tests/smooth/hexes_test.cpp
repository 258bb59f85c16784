#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/smooth/hexes.hpp>

#include "smooth/meshes.hpp"
#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

using namespace pavior;
using namespace pavior_test;

namespace {

SmoothReport untangle(HexGrid& grid, const UntangleOptions& options = {}, std::span<const Vec3> reference = {}) {
    return untangle_hexes(grid.nodes, grid.hexes, grid.fixed, options, reference);
}

// A square column, turned by `turn` from bottom to top and bent to an arc of 90 degrees.
HexGrid twisted_column(Index n, Index layers, double turn) {
    HexGrid grid = hex_grid(n, n, layers);
    const double half = 0.5 * static_cast<double>(n);
    for (Vec3& x : grid.nodes) {
        const double t = x.z() / static_cast<double>(layers);
        const Eigen::Rotation2Dd rotation(turn * t);
        const Vec2 p = rotation * Vec2((x.x() - half) / half, (x.y() - half) / half);
        const double a = 0.5 * std::numbers::pi * t;
        x = Vec3((4.0 + p.x()) * std::cos(a), p.y(), (4.0 + p.x()) * std::sin(a));
    }
    return grid;
}

}  // namespace

TEST_CASE("a hexahedral mesh without inverted hexahedra is not touched", "[hexes]") {
    HexGrid grid = hex_grid(5, 4, 6);
    shake(grid, 0.12, 1);
    const HexGrid before = grid;
    REQUIRE(count_inverted(grid.nodes, grid.hexes) == 0);
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.iterations == 0);
    CHECK(grid.nodes == before.nodes);
}

TEST_CASE("random tangles of a box are repaired, the boundary stays", "[hexes]") {
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        HexGrid grid = hex_grid(6, 5 + seed, 7);
        shake(grid, seed % 2 == 0 ? 5.0 : 0.9, seed);
        const HexGrid before = grid;
        const SmoothReport report = untangle(grid);
        CHECK(report.inverted_before > 50);
        CHECK(report.status == SmoothStatus::repaired);
        CHECK(report.inverted_after == 0);
        CHECK(report.min_det_after > 0.0);
        CHECK(count_inverted(grid.nodes, grid.hexes, 1) == 0);
        CHECK(fixed_kept(before, grid));
    }
}

TEST_CASE("with positivity sampled the trilinear map is positive at 27 points", "[hexes]") {
    for (unsigned seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        HexGrid grid = hex_grid(6, 6, 6);
        shake(grid, 0.45, seed);
        UntangleOptions options;
        options.positivity = HexPositivity::sampled;
        const SmoothReport report = untangle(grid, options);
        CHECK(report.inverted_before > 0);
        CHECK(report.status == SmoothStatus::repaired);
        CHECK(count_inverted(grid.nodes, grid.hexes, 2) == 0);
    }
}

TEST_CASE("a twisted and bent sweep is untangled and regains its quality", "[hexes]") {
    HexGrid grid = twisted_column(6, 14, 0.9);
    const double quality = [&] {
        HexGrid copy = grid;
        return untangle(copy).min_det_before;
    }();
    REQUIRE(count_inverted(grid.nodes, grid.hexes) == 0);
    shake(grid, 0.5, 5);
    const HexGrid before = grid;
    REQUIRE(count_inverted(grid.nodes, grid.hexes) > 100);
    UntangleOptions options;
    options.always = true;
    const SmoothReport report = untangle(grid, options);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(count_inverted(grid.nodes, grid.hexes) == 0);
    CHECK(report.min_det_after > 0.95 * quality);
    CHECK(fixed_kept(before, grid));
}

TEST_CASE("always raises the minimum of valid hexahedra and never lowers it", "[hexes]") {
    HexGrid grid = hex_grid(7, 7, 7);
    shake(grid, 0.15, 2);
    const HexGrid before = grid;
    UntangleOptions options;
    options.always = true;
    const SmoothReport report = untangle(grid, options);
    CHECK(report.inverted_before == 0);
    CHECK(report.status == SmoothStatus::improved);
    CHECK(report.min_det_after > 0.95);
    CHECK(report.moved_nodes == 6 * 6 * 6);
    CHECK(fixed_kept(before, grid));
}

TEST_CASE("only the surroundings of an inverted hexahedron move", "[hexes]") {
    HexGrid grid = hex_grid(16, 16, 16);
    const HexGrid before = grid;
    const Index centre = 8 + 17 * 8 + 17 * 17 * 8;
    grid.nodes[centre] += Vec3(1.3, 0.2, 0.4);
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(count_inverted(grid.nodes, grid.hexes) == 0);
    std::size_t far = 0;
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const bool moved = grid.nodes[i] != before.nodes[i];
        far += moved && (before.nodes[i] - before.nodes[centre]).lpNorm<Eigen::Infinity>() > 2.5 ? 1U : 0U;
    }
    CHECK(far == 0);
}

TEST_CASE("a hexahedron inverted by fixed nodes alone is reported, the others are repaired", "[hexes]") {
    HexGrid grid = hex_grid(6, 6, 6);
    grid.nodes[0] = Vec3(1.2, 0.9, 0.9);
    grid.nodes[3 + 7 * 3 + 49 * 3] += Vec3(1.4, 1.0, 0.3);
    const HexGrid before = grid;
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_ids == std::vector<Index>{0});
    CHECK(report.inverted_after == 1);
    CHECK(fixed_kept(before, grid));
}

TEST_CASE("hexahedra that contradict each other at a fixed node are seen at once", "[hexes]") {
    const auto id = [](Index i, Index j, Index k) { return i + 13 * j + 169 * k; };
    HexGrid grid = hex_grid(12, 12, 12);
    std::swap(grid.nodes[id(5, 6, 12)], grid.nodes[id(6, 6, 12)]);  // two nodes of the upper face
    const HexGrid before = grid;
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.iterations == 0);
    CHECK(grid.nodes == before.nodes);
    shake(grid, 2.0, 5);  // and the others are repaired none the less
    const SmoothReport other = untangle(grid);
    CHECK(other.inverted_before > 1500);
    CHECK(other.inverted_after <= report.inverted_after);
    CHECK(other.iterations < 500);
}

TEST_CASE("keep_minimum refuses fewer inverted hexahedra with a worse worst", "[hexes]") {
    std::size_t lowered = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        HexGrid grid = hex_grid(3, 3, 3);
        Random random(seed);
        for (Vec3& x : grid.nodes) {
            x += Vec3(random(-0.7, 0.7), random(-0.7, 0.7), random(-0.7, 0.7));
        }
        HexGrid copy = grid;
        UntangleOptions options;
        const SmoothReport free = untangle(copy, options);
        options.keep_minimum = true;
        const SmoothReport kept = untangle(grid, options);
        lowered += free.min_det_after < free.min_det_before ? 1U : 0U;
        CHECK(kept.min_det_after >= kept.min_det_before);
        CHECK(kept.inverted_after <= kept.inverted_before);
        CHECK(free.inverted_after <= kept.inverted_after);
    }
    CHECK(lowered > 0);
}

TEST_CASE("a box turned inside out comes back no worse, with its ids", "[hexes]") {
    HexGrid grid = hex_grid(3, 3, 3);
    for (Vec3& x : grid.nodes) {
        x.z() = -x.z();
    }
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_before == 27);
    CHECK(report.inverted_after <= 27);
    CHECK(report.inverted_ids.size() == report.inverted_after);
}

TEST_CASE("hexes: scale and position do not matter", "[hexes]") {
    HexGrid base = hex_grid(6, 6, 6);
    shake(base, 0.7, 7);
    HexGrid plain = base;
    const SmoothReport report = untangle(plain);
    for (const double scale : {1e-6, 1e6, 1e-100, 1e100}) {
        CAPTURE(scale);
        HexGrid grid = base;
        for (Vec3& x : grid.nodes) {
            x = scale * (x + Vec3(100, -200, 300));
        }
        const SmoothReport other = untangle(grid);
        CHECK(other.status == report.status);
        CHECK(other.inverted_before == report.inverted_before);
        double worst = 0.0;
        for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
            worst = std::max(worst, (grid.nodes[i] / scale - Vec3(100, -200, 300) - plain.nodes[i]).norm());
        }
        CHECK(worst < 0.05);
    }
}

TEST_CASE("hexes: same bytes for any number of threads", "[hexes]") {
    HexGrid one = hex_grid(13, 13, 13);
    shake(one, 5.0, 2);
    HexGrid three = one;
    UntangleOptions options;
    const SmoothReport a = untangle(one, options);
    options.execution = Execution{3};
    const SmoothReport b = untangle(three, options);
    CHECK(a.status == SmoothStatus::repaired);
    CHECK(a.iterations == b.iterations);
    CHECK(one.nodes == three.nodes);
}

TEST_CASE("hexes: a stop leaves the mesh as it was, before anything and in the middle", "[hexes]") {
    HexGrid grid = hex_grid(8, 8, 8);
    shake(grid, 5.0, 3);
    const HexGrid before = grid;
    for (const double when : {0.0, 0.01, 0.5}) {
        std::stop_source source;
        UntangleOptions options;
        options.always = true;
        options.execution = {2, source.get_token()};
        std::vector<double> seen;
        options.progress = [&](std::string_view, double fraction) {
            seen.push_back(fraction);
            if (fraction >= when) {
                source.request_stop();
            }
        };
        CHECK_THROWS_AS(untangle(grid, options), Stopped);
        CHECK(grid.nodes == before.nodes);
        CHECK(std::is_sorted(seen.begin(), seen.end()));
        CHECK(seen.back() >= when);
        CHECK(seen.back() < 1.0);
    }
}

TEST_CASE("thin layers keep their shape with a reference", "[hexes]") {
    HexGrid grid = hex_grid(6, 6, 10);
    for (Vec3& x : grid.nodes) {
        x.z() *= 0.02;
    }
    const HexGrid source = grid;
    const Index centre = 3 + 7 * 3 + 49 * 5;
    grid.nodes[centre].z() += 0.05;
    const SmoothReport report = untangle(grid, {}, source.nodes);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK((grid.nodes[centre] - source.nodes[centre]).norm() < 0.01);
}

TEST_CASE("hexes as an Eigen matrix", "[hexes]") {
    const HexGrid grid = hex_grid(4, 4, 4);
    Eigen::Matrix3Xd V(3, 125);
    Eigen::Matrix<Index, 8, Eigen::Dynamic> H(8, 64);
    for (Eigen::Index i = 0; i < 125; ++i) {
        V.col(i) = grid.nodes[static_cast<std::size_t>(i)];
    }
    V.col(62) += Vec3(1.2, 1.7, 0.1);
    for (Eigen::Index h = 0; h < 64; ++h) {
        for (Eigen::Index k = 0; k < 8; ++k) {
            H(k, h) = grid.hexes[static_cast<std::size_t>(h)][static_cast<std::size_t>(k)];
        }
    }
    const SmoothReport report = untangle_hexes({reinterpret_cast<Vec3*>(V.data()), 125},
                                               {reinterpret_cast<const HexCorners*>(H.data()), 64}, grid.fixed);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK((V.col(62) - Vec3(2, 2, 2)).norm() < 0.3);
}

TEST_CASE("hexes: callers' mistakes", "[hexes]") {
    HexGrid grid = hex_grid(2, 2, 2);
    const auto code_of = [&](const HexGrid& given) {
        HexGrid copy = given;
        try {
            untangle(copy);
        } catch (const InputError& error) {
            CHECK(error.ids().size() <= 1);
            return error.code();
        }
        return ErrorCode::unreadable_file;
    };
    HexGrid bad = grid;
    bad.fixed.push_back(0);
    CHECK(code_of(bad) == ErrorCode::size_mismatch);
    bad = grid;
    bad.hexes[7][0] = 27;
    CHECK(code_of(bad) == ErrorCode::bad_index);
    bad = grid;
    bad.nodes[13].z() = NAN;
    CHECK(code_of(bad) == ErrorCode::not_finite);
}

TEST_CASE("untangle_hexes reads a foreign mesh and an archetype", "[hexes]") {
    HexGrid grid = hex_grid(4, 4, 4);
    shake(grid, 0.9, 3);
    for (Vec3& x : grid.nodes) {
        x = x.cast<float>().cast<double>();
    }
    HexGrid copy = grid;
    const SmoothReport expected = untangle(copy);
    CHECK(expected.status == SmoothStatus::repaired);
    const archetype::Hexes minimal(HexMesh{grid.nodes, grid.hexes});
    const UntangledHexes result = untangle_hexes(minimal, grid.fixed);
    CHECK(result.nodes == copy.nodes);
    CHECK(result.report.iterations == expected.iterations);
    CHECK(minimal.get().nodes == grid.nodes);
    const std::vector<Vec3> reference = hex_grid(4, 4, 4).nodes;
    untangle(grid, {}, reference);
    CHECK(untangle_hexes(minimal, grid.fixed, {}, reference).nodes == grid.nodes);
    CHECK_THROWS_AS(untangle_hexes(minimal, std::span(grid.fixed).first(3)), InputError);
}
