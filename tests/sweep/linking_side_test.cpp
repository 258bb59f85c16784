#include "support/catch.hpp"
#include "sweep/surfaces.hpp"

#include <pavior/sweep/linking_side.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

/// Sides of a patch, in the parameters and in space.
struct Sides {
    std::vector<Vec2> bottom_uv, top_uv, left_uv, right_uv;
    std::vector<Vec3> bottom, top, left, right;
    [[nodiscard]] GridSides<Vec2> uv() const { return {bottom_uv, top_uv, left_uv, right_uv}; }
    [[nodiscard]] GridSides<Vec3> space() const { return {bottom, top, left, right}; }
};

/// The patch uv(s, t), 0 <= s, t <= 1, in m x r quads.
template <class S>
Sides patch(const S& surface, const std::function<Vec2(double, double)>& uv, std::size_t m, std::size_t r) {
    Sides sides;
    const auto add = [&](std::vector<Vec2>& in_plane, std::vector<Vec3>& in_space, double s, double t) {
        in_plane.push_back(uv(s, t));
        in_space.push_back(surface.point(uv(s, t)));
    };
    for (std::size_t i = 0; i <= m; ++i) {
        const double s = static_cast<double>(i) / static_cast<double>(m);
        add(sides.bottom_uv, sides.bottom, s, 0.0);
        add(sides.top_uv, sides.top, s, 1.0);
    }
    for (std::size_t k = 0; k <= r; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(r);
        add(sides.left_uv, sides.left, 0.0, t);
        add(sides.right_uv, sides.right, 1.0, t);
    }
    return sides;
}

void check_border(const Sides& sides, const LinkingSideMesh& side) {
    const std::size_t m = side.nodes.columns;
    const std::size_t r = side.nodes.rows;
    for (std::size_t i = 0; i <= m; ++i) {
        CHECK(side.nodes(i, 0) == sides.bottom[i]);
        CHECK(side.nodes(i, r) == sides.top[i]);
    }
    for (std::size_t k = 1; k < r; ++k) {
        CHECK(side.nodes(0, k) == sides.left[k]);
        CHECK(side.nodes(m, k) == sides.right[k]);
    }
}

template <class S>
void check_on_surface(const S& surface, const LinkingSideMesh& side) {
    for (std::size_t k = 1; k < side.nodes.rows; ++k) {
        for (std::size_t i = 1; i < side.nodes.columns; ++i) {
            CHECK(side.nodes(i, k) == surface.point(side.uv(i, k)));
        }
    }
}

Vec2 wavy(double s, double t) { return {2.0 * s + 0.1 * std::sin(6.0 * t) * s, t + 0.1 * std::sin(6.0 * s)}; }

}  // namespace

TEST_CASE("sides on curved surfaces: nodes on the surface, the border untouched, nothing folded") {
    const auto check = [](const auto& surface, bool reversed) {
        const auto uv = [reversed](double s, double t) {
            return reversed ? Vec2(wavy(s, t).y(), wavy(s, t).x()) : wavy(s, t);
        };
        const Sides sides = patch(surface, uv, 9, 7);
        const LinkingSideMesh side = linking_side(surface, sides.space(), sides.uv());
        CHECK(side.way == LinkingWay::parameter);
        CHECK(side.reversed == reversed);
        CHECK(side.folded_parameter.empty());
        CHECK(side.folded.empty());
        CHECK(side.smooth.iterations == 0);
        check_border(sides, side);
        check_on_surface(surface, side);
    };
    for (const bool reversed : {false, true}) {
        check(surfaces::SkewPlane{}, reversed);
        check(surfaces::Cylinder{}, reversed);
        check(surfaces::Cylinder{0.5, true}, reversed);
        check(surfaces::Torus{}, reversed);
        check(surfaces::Saddle{}, reversed);
    }
    check(surfaces::Sphere{}, false);
}

TEST_CASE("a full turn of a cylinder, unwrapped from parameters in one period") {
    const surfaces::Cylinder surface;
    const double turn = 2.0 * std::numbers::pi;
    Sides sides = patch(
        surface, [turn](double s, double t) { return Vec2(turn * s + 1.0, t); }, 8, 3);
    for (auto* chain : {&sides.bottom_uv, &sides.top_uv, &sides.left_uv, &sides.right_uv}) {
        for (Vec2& p : *chain) {
            p.x() = std::fmod(p.x(), turn);
        }
        unwrap_chain(*chain, {turn, 0.0});
    }
    CHECK_FALSE(sides.right_uv[0].x() == Approx(1.0 + turn));
    REQUIRE(unwrap_sides(sides.bottom_uv, sides.top_uv, sides.left_uv, sides.right_uv, {turn, 0.0}, 1e-9).closed);
    const LinkingSideMesh side = linking_side(surface, sides.space(), sides.uv());
    CHECK(side.folded.empty());
    CHECK(side.uv(8, 1).x() == Approx(1.0 + turn));
    check_border(sides, side);
}

TEST_CASE("distorted parameters: closest points where they help, untangling where they do not exist") {
    // A rectangle in space whose sides are strongly bent in the parameter plane.
    const surfaces::Swirl surface{0.9};
    const auto uv = [&](double s, double t) { return surface.closest(Vec3(2.0 * s - 0.6, 1.6 * t - 0.5, 0.0)); };
    const Sides sides = patch(surface, uv, 12, 12);
    LinkingSideOptions off;
    off.repair = false;
    const LinkingSideMesh plain = linking_side(surface, sides.space(), sides.uv(), off);
    REQUIRE(plain.folded.size() > 3);
    CHECK(plain.folded == plain.folded_parameter);
    CHECK(plain.way == LinkingWay::parameter);

    const auto closest = [&](const Vec3& x) { return surface.closest(x); };
    const LinkingSideMesh moved = linking_side(surface, sides.space(), sides.uv(), {}, closest);
    CHECK(moved.way == LinkingWay::closest_point);
    CHECK(moved.folded_parameter == plain.folded_parameter);
    CHECK(moved.folded.empty());
    CHECK((moved.nodes(6, 6) - Vec3(0.4, 0.3, 0.0)).norm() < 1e-12);
    check_border(sides, moved);
    check_on_surface(surface, moved);

    const LinkingSideMesh untangled = linking_side(surface, sides.space(), sides.uv());
    CHECK(untangled.way == LinkingWay::parameter);
    CHECK(untangled.folded.empty());
    CHECK(untangled.smooth.inverted_before > 0);
    check_border(sides, untangled);
    check_on_surface(surface, untangled);
}

TEST_CASE("closest points of a periodic surface are unwrapped") {
    const surfaces::Cylinder surface;
    const double turn = 2.0 * std::numbers::pi;
    // A strip across the seam of atan2 that folds in the middle: its top is far below its bottom's bulge.
    const auto uv = [](double s, double t) {
        const double bulge = 1.4 * std::sin(std::numbers::pi * s);
        return Vec2(2.0 + 2.5 * s, t + bulge * (1.0 - 0.3 * t * t));
    };
    const Sides sides = patch(surface, uv, 10, 6);
    LinkingSideOptions options;
    options.periods = {turn, 0.0};
    const LinkingSideMesh side =
        linking_side(surface, sides.space(), sides.uv(), options, [&](const Vec3& x) { return surface.closest(x); });
    CHECK(side.folded.empty());
    for (const Vec2& p : side.uv.nodes) {
        CHECK(p.x() > 1.9);
        CHECK(p.x() < 4.6);
    }
}

TEST_CASE("an arch whose opposite sides run at different speeds is untangled on curved surfaces") {
    const auto check = [](const auto& surface, double scale) {
        // An arch.
        const auto uv = [scale](double s, double t) {
            const double x = 2.0 * s - 1.0;
            return Vec2(scale * x, scale * (t * 0.6 + (1.0 - x * x) * (1.2 - 0.2 * t)));
        };
        const auto sheared = [&](double s, double t) { return uv(t < 0.5 ? s * s : 1.0 - (1.0 - s) * (1.0 - s), t); };
        const Sides sides = patch(surface, sheared, 12, 5);
        LinkingSideOptions off;
        off.repair = false;
        const LinkingSideMesh plain = linking_side(surface, sides.space(), sides.uv(), off);
        CHECK_FALSE(plain.folded.empty());
        const LinkingSideMesh side = linking_side(surface, sides.space(), sides.uv());
        INFO(plain.folded.size() << " folded -> " << side.folded.size() << ", min det " << side.smooth.min_det_after);
        CHECK(side.folded.empty());
        check_border(sides, side);
        check_on_surface(surface, side);
    };
    check(surfaces::FlatPlane{}, 1.0);
    check(surfaces::Cylinder{}, 0.6);
    check(surfaces::Sphere{}, 0.6);
    check(surfaces::Saddle{0.3}, 1.0);
}

TEST_CASE("without a surface the sides are interpolated in space") {
    const surfaces::Torus surface;
    const Sides sides = patch(surface, wavy, 6, 4);
    const LinkingSideMesh side = linking_side(sides.space());
    CHECK(side.way == LinkingWay::space);
    CHECK(side.uv.nodes.empty());
    CHECK(side.folded.empty());
    CHECK(side.nodes.nodes == transfinite(sides.space()).nodes);
    check_border(sides, side);
}

TEST_CASE("parameters and nodes must agree in number") {
    const surfaces::FlatPlane plane;
    const Sides fine = patch(plane, wavy, 6, 4);
    const Sides coarse = patch(plane, wavy, 5, 4);
    try {
        static_cast<void>(linking_side(plane, fine.space(), coarse.uv()));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::size_mismatch);
    }
}
