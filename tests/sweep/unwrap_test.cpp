#include "support/catch.hpp"

#include <pavior/sweep/unwrap.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

using namespace pavior;

namespace {
constexpr double turn = 2.0 * std::numbers::pi;
constexpr Periods around{turn, 0.0};
}  // namespace

TEST_CASE("the nearest image is at most half a period away") {
    for (const double u : {-20.0, -3.0, 0.0, 1.0, 6.2, 40.0}) {
        const Vec2 p(u, 5.0);
        const Vec2 moved = p + nearest_image_shift(p, {1.0, -70.0}, around);
        CHECK(std::abs(moved.x() - 1.0) <= turn / 2.0 + 1e-12);
        CHECK(moved.y() == 5.0);
        CHECK(std::abs(std::remainder(moved.x() - u, turn)) < 1e-12);
    }
    CHECK(nearest_image_shift({0.0, 0.0}, {turn / 2.0, 0.0}, around) == Vec2::Zero());
    CHECK(nearest_image_shift({0.0, 0.0}, {-turn / 2.0, 0.0}, around) == Vec2::Zero());
}

TEST_CASE("a chain across the seam becomes continuous") {
    std::vector<Vec2> chain;
    for (int i = 0; i <= 20; ++i) {
        chain.emplace_back(std::fmod(5.0 + 0.1 * i, turn), 0.0);
    }
    unwrap_chain(chain, around);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        CHECK(chain[i].x() == Approx(5.0 + 0.1 * static_cast<double>(i)).epsilon(1e-14));
    }
}

TEST_CASE("the sides of a patch across the seam close") {
    std::vector<Vec2> bottom{{5.0, 0.0}, {6.0, 0.0}, {7.0, 0.0}};
    std::vector<Vec2> right{{7.0 - turn, 0.0}, {7.0 - turn, 1.0}};
    std::vector<Vec2> top{{5.0 - turn, 1.0}, {6.0 - turn, 1.0}, {7.0 - turn, 1.0}};
    std::vector<Vec2> left{{5.0 + turn, 0.0}, {5.0 + turn, 1.0}};
    const UnwrapReport report = unwrap_sides(bottom, top, left, right, around, 1e-9);
    CHECK(report.closed);
    CHECK(report.gap.norm() < 1e-14);
    CHECK(bottom[0].x() == 5.0);
    CHECK(right[1].x() == Approx(7.0));
    CHECK(top[0].x() == Approx(5.0));
    CHECK(left[1].x() == Approx(5.0));
}

TEST_CASE("a full turn between the two images of the seam closes; a ring without seam does not") {
    std::vector<Vec2> bottom;
    std::vector<Vec2> top;
    for (int i = 0; i <= 8; ++i) {
        bottom.emplace_back(turn * i / 8.0, 0.0);
        top.emplace_back(turn * i / 8.0 + turn, 1.0);
    }
    std::vector<Vec2> left{{0.0, 0.0}, {0.0, 1.0}};
    std::vector<Vec2> right = left;
    const std::array<std::span<Vec2>, 4> loop{bottom, right, {}, {}};
    CHECK(unwrap_sides(bottom, top, left, right, around, 1e-9).closed);
    CHECK(right[0].x() == Approx(turn));
    CHECK(left[0].x() == Approx(0.0).margin(1e-14));

    std::vector<Vec2> ring(bottom);
    const std::array<std::span<Vec2>, 1> rings{ring};
    const UnwrapReport report = unwrap_loop(rings, around, 1e-9);
    CHECK_FALSE(report.closed);
    CHECK(std::abs(report.gap.x()) == Approx(turn));
    CHECK_FALSE(unwrap_loop(loop, around, 1e-9).closed);
}

TEST_CASE("a loop of chains on a torus closes in both directions") {
    const Periods both{turn, 3.0};
    std::vector<Vec2> a{{6.0, 2.5}, {7.0, 2.5}};
    std::vector<Vec2> b{{7.0 - turn, -0.5}, {7.0 - turn, 0.5}};
    std::vector<Vec2> c{{7.0, 0.5 - 3.0}, {6.0, 0.5 - 3.0}};
    std::vector<Vec2> d{{6.0 - turn, 0.5}, {6.0 - turn, -0.5}};
    const std::array<std::span<Vec2>, 4> loop{a, b, c, d};
    const UnwrapReport report = unwrap_loop(loop, both, 1e-9);
    CHECK(report.closed);
    CHECK((b[1] - Vec2(7.0, 3.5)).norm() < 1e-14);
    CHECK((d[1] - Vec2(6.0, 2.5)).norm() < 1e-14);
}

TEST_CASE("a gap that is no period is reported") {
    std::vector<Vec2> a{{0.0, 0.0}, {1.0, 0.0}};
    std::vector<Vec2> b{{1.0, 0.25}, {0.0, 0.0}};
    const std::array<std::span<Vec2>, 2> loop{a, b};
    const UnwrapReport report = unwrap_loop(loop, around, 1e-3);
    CHECK_FALSE(report.closed);
    CHECK(report.gap == Vec2(0.0, 0.25));
    CHECK(unwrap_loop({}, around, 1e-3).closed);
}

TEST_CASE("points and holes move inside the outer loop by whole periods") {
    const std::vector<Vec2> outer{{5.0, 0.0}, {9.0, 0.0}, {9.0, 1.0}, {5.0, 1.0}};
    CHECK(inside_polygon({6.0, 0.5}, outer));
    CHECK_FALSE(inside_polygon({4.0, 0.5}, outer));
    const Vec2 p(1.0, 0.5);
    CHECK((p + inside_shift(p, outer, around)).x() == Approx(1.0 + turn));
    const Vec2 q(5.5 - 2.0 * turn, 0.5);
    CHECK((q + inside_shift(q, outer, around)).x() == Approx(5.5));
    CHECK(inside_shift({3.0, 9.0}, outer, {0.0, 0.0}) == Vec2::Zero());
}
