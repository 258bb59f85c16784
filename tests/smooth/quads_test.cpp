#include <pavior/core/error.hpp>
#include <pavior/smooth/quads.hpp>

#include "smooth/meshes.hpp"
#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <numbers>

using namespace pavior;
using namespace pavior_test;

namespace {

SmoothReport untangle(QuadGrid& grid, const UntangleOptions& options = {}, std::span<const Vec2> reference = {}) {
    return untangle_quads(grid.nodes, grid.quads, grid.fixed, options, reference);
}

// Concave images of the unit circle by angle t.
Vec2 kidney(double t) { return {1.5 * std::cos(t) + 0.9 * std::cos(2 * t), std::sin(t)}; }
Vec2 star(double t) { return (1.0 + 0.45 * std::cos(5 * t)) * Vec2(std::cos(t), std::sin(t)); }
Vec2 hook(double t) {
    const double a = 0.5 * std::numbers::pi * (1.0 + 0.9 * std::cos(t)) * 1.6;
    return (2.0 + 0.5 * std::sin(t)) * Vec2(-std::cos(a), std::sin(a));
}

// The circle of `grid` goes to `shape`, the inner nodes by the affine map that fits best (least squares).
template <class Shape>
void map_to(QuadGrid& grid, Shape shape) {
    Eigen::Matrix2d yx = Eigen::Matrix2d::Zero();
    Eigen::Matrix2d xx = Eigen::Matrix2d::Zero();
    Vec2 centre = Vec2::Zero();
    double count = 0.0;
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        if (grid.fixed[i] != 0) {
            centre += shape(std::atan2(grid.nodes[i].y(), grid.nodes[i].x()));
            count += 1.0;
        }
    }
    centre /= count;
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        if (grid.fixed[i] != 0) {
            const Vec2 y = shape(std::atan2(grid.nodes[i].y(), grid.nodes[i].x())) - centre;
            yx += y * grid.nodes[i].transpose();
            xx += grid.nodes[i] * grid.nodes[i].transpose();
        }
    }
    const Eigen::Matrix2d A = yx * xx.inverse();
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const Vec2 x = grid.nodes[i];
        grid.nodes[i] = grid.fixed[i] != 0 ? shape(std::atan2(x.y(), x.x())) : Vec2(A * x + centre);
    }
}

}  // namespace

TEST_CASE("a quad mesh without inverted quads is not touched", "[quads]") {
    QuadGrid grid = quad_grid(6, 5);
    shake(grid, 0.2, 1);
    const QuadGrid before = grid;
    REQUIRE(count_inverted(grid.nodes, grid.quads) == 0);
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.iterations == 0);
    CHECK(report.moved_nodes == 0);
    CHECK(report.min_det_before == report.min_det_after);
    CHECK(grid.nodes == before.nodes);
}

TEST_CASE("random tangles of a rectangle are repaired, the boundary stays", "[quads]") {
    for (unsigned seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        QuadGrid grid = quad_grid(16 + seed, 12);
        shake(grid, seed % 2 == 0 ? 12.0 : 1.2, seed);
        const QuadGrid before = grid;
        const SmoothReport report = untangle(grid);
        CHECK(report.inverted_before == count_inverted(before.nodes, before.quads));
        CHECK(report.inverted_before > 20);
        CHECK(report.status == SmoothStatus::repaired);
        CHECK(report.inverted_after == 0);
        CHECK(report.inverted_ids.empty());
        CHECK(count_inverted(grid.nodes, grid.quads) == 0);
        CHECK(fixed_kept(before, grid));
    }
}

TEST_CASE("a disc mapped affinely to a shape with concavities becomes valid", "[quads]") {
    const auto test = [](const char* name, auto shape, bool with_reference) {
        INFO(name << (with_reference ? " with reference" : ""));
        QuadGrid grid = disc(8, 5);
        const QuadGrid source = grid;
        REQUIRE(count_inverted(grid.nodes, grid.quads) == 0);
        map_to(grid, shape);
        const QuadGrid before = grid;
        REQUIRE(count_inverted(grid.nodes, grid.quads) > 0);
        const SmoothReport report =
            untangle(grid, {}, with_reference ? std::span<const Vec2>(source.nodes) : std::span<const Vec2>());
        CHECK(report.status == SmoothStatus::repaired);
        CHECK(count_inverted(grid.nodes, grid.quads) == 0);
        CHECK(fixed_kept(before, grid));
    };
    for (const bool with_reference : {false, true}) {
        test("kidney", kidney, with_reference);
        test("star", star, with_reference);
        test("hook", hook, with_reference);
    }
}

TEST_CASE("only the surroundings of an inverted quad move", "[quads]") {
    QuadGrid grid = quad_grid(30, 30);
    const QuadGrid before = grid;
    const Index centre = 15 + 31 * 15;
    grid.nodes[centre] += Vec2(1.6, 0.3);
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(count_inverted(grid.nodes, grid.quads) == 0);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const bool changed = grid.nodes[i] != before.nodes[i];
        moved += changed ? 1U : 0U;
        CHECK((!changed || (grid.nodes[i] - before.nodes[centre]).lpNorm<Eigen::Infinity>() < 4.0));
    }
    CHECK(moved <= 16);
    CHECK(report.moved_nodes >= moved);
}

TEST_CASE("a quad folded by fixed nodes alone is reported, the others are repaired", "[quads]") {
    QuadGrid grid = quad_grid(10, 10);
    grid.nodes[0] = Vec2(0.8, 0.8);  // the corner quad is concave at the corner
    grid.nodes[5 + 11 * 5] = Vec2(7.3, 6.2);
    const QuadGrid before = grid;
    const SmoothReport report = untangle(grid);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_after == 1);
    REQUIRE(report.inverted_ids == std::vector<Index>{0});
    CHECK(inverted(grid.nodes, grid.quads[0]));
    CHECK(count_inverted(grid.nodes, grid.quads) == 1);
    CHECK(fixed_kept(before, grid));
}

TEST_CASE("a mesh that cannot be repaired at all comes back as it was", "[quads]") {
    QuadGrid grid = quad_grid(4, 4);
    for (Vec2& x : grid.nodes) {
        x.x() = -x.x();
    }
    const QuadGrid before = grid;
    UntangleOptions options;
    options.max_ids = 5;
    const SmoothReport report = untangle(grid, options);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_before == 16);
    CHECK(report.inverted_after <= 16);
    CHECK(report.inverted_ids.size() == 5);
    CHECK(fixed_kept(before, grid));
    CHECK(count_inverted(grid.nodes, grid.quads) == report.inverted_after);
}

TEST_CASE("always raises the minimum of a valid mesh and never lowers it", "[quads]") {
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        QuadGrid grid = quad_grid(14, 14);
        shake(grid, 0.3, seed);
        const QuadGrid before = grid;
        UntangleOptions options;
        options.always = true;
        const SmoothReport report = untangle(grid, options);
        CHECK(report.min_det_after >= report.min_det_before);
        CHECK(report.min_det_after > 0.95);
        CHECK(fixed_kept(before, grid));
        const QuadGrid first = grid;
        const SmoothReport again = untangle(grid, options);
        CHECK(again.min_det_after >= report.min_det_after);
        CHECK(again.inverted_before == 0);
        CHECK((again.status == SmoothStatus::unchanged) == (grid.nodes == first.nodes));
    }
}

TEST_CASE("an affine image of the reference is reached with the reference", "[quads]") {
    QuadGrid grid = disc(6, 4);
    const QuadGrid source = grid;
    Eigen::Matrix2d A;
    A << 2.0, 0.7, 0.1, 1.3;
    for (Vec2& x : grid.nodes) {
        x = A * x;
    }
    const QuadGrid wanted = grid;
    shake(grid, 0.9, 3);
    REQUIRE(count_inverted(grid.nodes, grid.quads) > 30);
    UntangleOptions options;
    options.local = false;
    options.sufficient_det = 0.0;
    CHECK(untangle(grid, options, source.nodes).status == SmoothStatus::repaired);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK((grid.nodes[i] - wanted.nodes[i]).norm() < 0.02);
    }
}

TEST_CASE("quads: scale and position do not matter", "[quads]") {
    QuadGrid base = quad_grid(12, 12);
    shake(base, 1.0, 7);
    QuadGrid plain = base;
    const SmoothReport report = untangle(plain);
    for (const double scale : {1e-6, 1e6, 1e-150, 1e150}) {
        for (const double shift : {0.0, 1e4}) {
            CAPTURE(scale, shift);
            QuadGrid grid = base;
            for (Vec2& x : grid.nodes) {
                x = scale * (x + Vec2(shift, -shift));
            }
            const SmoothReport other = untangle(grid);
            CHECK(other.status == report.status);
            CHECK(other.inverted_before == report.inverted_before);
            double worst = 0.0;
            for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
                worst = std::max(worst, (grid.nodes[i] / scale - Vec2(shift, -shift) - plain.nodes[i]).norm());
            }
            CHECK(worst < 0.05);
        }
    }
}

TEST_CASE("quads: same bytes for any number of threads", "[quads]") {
    QuadGrid one = quad_grid(60, 60);
    shake(one, 30.0, 2);
    QuadGrid four = one;
    UntangleOptions options;
    const SmoothReport a = untangle(one, options);
    options.execution = Execution{4};
    const SmoothReport b = untangle(four, options);
    CHECK(a.status == SmoothStatus::repaired);
    CHECK(a.iterations == b.iterations);
    CHECK(a.min_det_after == b.min_det_after);
    CHECK(one.nodes == four.nodes);
}

TEST_CASE("quads as an Eigen matrix", "[quads]") {
    const QuadGrid grid = quad_grid(8, 8);
    Eigen::Matrix2Xd V(2, 81);
    Eigen::Matrix<Index, 4, Eigen::Dynamic> F(4, 64);
    for (Eigen::Index i = 0; i < 81; ++i) {
        V.col(i) = grid.nodes[static_cast<std::size_t>(i)];
    }
    V.col(40) += Vec2(2.2, 1.7);
    for (Eigen::Index q = 0; q < 64; ++q) {
        for (Eigen::Index k = 0; k < 4; ++k) {
            F(k, q) = grid.quads[static_cast<std::size_t>(q)][static_cast<std::size_t>(k)];
        }
    }
    const SmoothReport report = untangle_quads({reinterpret_cast<Vec2*>(V.data()), 81},
                                               {reinterpret_cast<const QuadCorners*>(F.data()), 64}, grid.fixed);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK((V.col(40) - Vec2(4, 4)).norm() < 0.3);
}

TEST_CASE("quads: progress goes from 0 to 1", "[quads]") {
    QuadGrid grid = quad_grid(20, 20);
    shake(grid, 0.8, 4);
    std::vector<double> seen;
    UntangleOptions options;
    options.progress = [&](std::string_view stage, double fraction) {
        CHECK(stage == "untangle");
        seen.push_back(fraction);
    };
    untangle(grid, options);
    REQUIRE(seen.size() >= 2);
    CHECK(seen.front() == 0.0);
    CHECK(seen.back() == 1.0);
    CHECK(std::is_sorted(seen.begin(), seen.end()));
}

TEST_CASE("quads: callers' mistakes", "[quads]") {
    const auto code_of = [](auto spoil) {
        QuadGrid grid = quad_grid(3, 3);
        grid.nodes[5] = Vec2(2.5, 2.5);
        UntangleOptions options;
        std::vector<Vec2> reference;
        spoil(grid, options, reference);
        const std::vector<Vec2> before = grid.nodes;
        try {
            untangle(grid, options, reference);
        } catch (const InputError& error) {
            CHECK(std::equal(before.begin(), before.end(), grid.nodes.begin(), [](const Vec2& a, const Vec2& b) {
                return (a.array() == b.array()).all() || !a.allFinite();
            }));
            return std::string(to_string(error.code()));
        }
        return std::string("none");
    };
    CHECK(code_of([](auto&, auto&, auto&) {}) == "none");
    CHECK(code_of([](auto& g, auto&, auto&) { g.fixed.pop_back(); }) == "size_mismatch");
    CHECK(code_of([](auto&, auto&, auto& r) { r.resize(3, Vec2(0, 0)); }) == "size_mismatch");
    CHECK(code_of([](auto& g, auto&, auto&) { g.quads[2][1] = 16; }) == "bad_index");
    CHECK(code_of([](auto& g, auto&, auto&) { g.quads[2][1] = g.quads[2][0]; }) == "bad_index");
    CHECK(code_of([](auto& g, auto&, auto&) { g.nodes[3].x() = NAN; }) == "not_finite");
    CHECK(code_of([](auto& g, auto&, auto& r) {
              r = g.nodes;
              r[1].y() = INFINITY;
          }) == "not_finite");
    CHECK(code_of([](auto&, auto& o, auto&) { o.max_iterations = 0; }) == "bad_option");
    CHECK(code_of([](auto&, auto& o, auto&) { o.inner_iterations = 0; }) == "bad_option");
    CHECK(code_of([](auto&, auto& o, auto&) { o.theta = 0.0; }) == "bad_option");
    CHECK(code_of([](auto&, auto& o, auto&) { o.theta = NAN; }) == "bad_option");
    CHECK(code_of([](auto&, auto& o, auto&) { o.sufficient_det = 1.0; }) == "bad_option");
}

TEST_CASE("no quads, no work", "[quads]") {
    QuadGrid empty;
    CHECK(untangle(empty).status == SmoothStatus::unchanged);
    UntangleOptions options;
    options.always = true;
    CHECK(untangle(empty, options).status == SmoothStatus::unchanged);
}

TEST_CASE("untangle_quads reads an archetype, along z", "[quads]") {
    QuadGrid grid = quad_grid(6, 6);
    shake(grid, 0.9, 3);
    QuadMesh mesh{{}, grid.quads};
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        grid.nodes[i] = grid.nodes[i].cast<float>().cast<double>();
        mesh.nodes.emplace_back(grid.nodes[i].x(), grid.nodes[i].y(), 0.5 * static_cast<double>(i));
    }
    const archetype::Quads minimal(mesh);
    const UntangledQuads result = untangle_quads(minimal, grid.fixed);
    CHECK(untangle(grid).status == SmoothStatus::repaired);
    CHECK(result.report.status == SmoothStatus::repaired);
    REQUIRE(result.nodes.size() == grid.nodes.size());
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK(result.nodes[i] == Vec3(grid.nodes[i].x(), grid.nodes[i].y(), mesh.nodes[i].z()));
    }
    CHECK_THROWS_AS(untangle_quads(minimal, std::span(grid.fixed).first(3)), InputError);
}
