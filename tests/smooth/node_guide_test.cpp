#include <pavior/smooth/node_guide.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

using namespace pavior;

namespace {

// The unit circle in the plane z = 0, without and with a tangent of its own.
struct Circle {
    static Freedom freedom(Index) { return Freedom::curve; }
    static Vec3 project(Index, const Vec3& x) { return Vec3(x.x(), x.y(), 0.0).normalized(); }
};
struct CircleWithTangent : Circle {
    static Vec3 direction(Index, const Vec3& x) { return {-7.0 * x.y(), 7.0 * x.x(), 0.0}; }
    static bool concurrent() { return true; }
};
struct NoProjection {
    static Freedom freedom(Index) { return Freedom::space; }
};
struct WrongFreedom {
    static int freedom(Index) { return 3; }
    static Vec3 project(Index, const Vec3& x) { return x; }
};

}  // namespace

TEST_CASE("what is a node_guide", "[node_guide]") {
    STATIC_REQUIRE(node_guide<FixedNodes>);
    STATIC_REQUIRE(node_guide<Circle>);
    STATIC_REQUIRE(node_guide<const CircleWithTangent&>);
    STATIC_REQUIRE_FALSE(node_guide<NoProjection>);
    STATIC_REQUIRE_FALSE(node_guide<WrongFreedom>);
    STATIC_REQUIRE_FALSE(node_guide<int>);
    CHECK_FALSE(detail::guide_concurrent(Circle{}));
    CHECK(detail::guide_concurrent(CircleWithTangent{}));
    CHECK(detail::guide_concurrent(FixedNodes{}));
}

TEST_CASE("fixed and free nodes", "[node_guide]") {
    const std::vector<std::uint8_t> flags{0, 1, 200};
    const FixedNodes guide{flags};
    CHECK(guide.freedom(0) == Freedom::space);
    CHECK(guide.freedom(1) == Freedom::fixed);
    CHECK(guide.freedom(2) == Freedom::fixed);
}

TEST_CASE("a lambda guides nodes", "[node_guide]") {
    const std::vector<Freedom> freedoms{Freedom::fixed, Freedom::surface};
    const double radius = 2.0;
    const GuidedNodes guide{freedoms, [&](Index i, const Vec3& x) { return Vec3((radius + i) * x.normalized()); }};
    STATIC_REQUIRE(node_guide<decltype(guide)>);
    CHECK(guide.freedom(1) == Freedom::surface);
    CHECK(guide.project(1, {0, 5, 0}).isApprox(Vec3(0, 3, 0)));
    CHECK_FALSE(guide.concurrent());
    const GuidedNodes safe{freedoms, [](Index, const Vec3& x) { return x; }, true};
    CHECK(safe.concurrent());
}

TEST_CASE("tangents and normals from projections alone", "[node_guide]") {
    for (double angle = 0.05; angle < 6.2; angle += 0.3) {
        const Vec3 x(std::cos(angle), std::sin(angle), 0.0);
        const Vec3 tangent(-x.y(), x.x(), 0.0);
        const auto along = [&](const auto& guide) {
            return std::abs(detail::guided_direction(guide, Freedom::curve, 0, x, 1e-4).dot(tangent));
        };
        CHECK(along(Circle{}) == Approx(1.0).margin(1e-6));
        CHECK(along(CircleWithTangent{}) == Approx(1.0).margin(1e-15));
        const Vec3 y = 4.0 * Vec3(x.x(), 0.3, x.y()).normalized();
        const GuidedNodes sphere{std::span<const Freedom>(),
                                 [](Index, const Vec3& at) { return Vec3(4.0 * at.normalized()); }};
        const Vec3 normal = detail::guided_direction(sphere, Freedom::surface, 0, y, 1e-4);
        CHECK(std::abs(normal.dot(y)) == Approx(4.0).margin(1e-6));
    }
}

TEST_CASE("a guide that refuses or has no tangent space", "[node_guide]") {
    const Vec3 x(1, 2, 3);
    const auto guide_to = [](const Vec3& target) {
        return GuidedNodes{std::span<const Freedom>(), [target](Index, const Vec3&) { return target; }};
    };
    const auto refusing = guide_to(Vec3(NAN, 0, 0));
    CHECK(detail::guided_point(refusing, 0, x, Vec3(7, 7, 7)) == Vec3(7, 7, 7));
    CHECK(detail::guided_direction(refusing, Freedom::surface, 0, x, 1e-3).isZero(0.0));
    const auto point = guide_to(x);
    CHECK(detail::guided_point(point, 0, Vec3(9, 9, 9), Vec3(7, 7, 7)) == x);
    CHECK(detail::guided_direction(point, Freedom::surface, 0, x, 1e-3).isZero(0.0));
    CHECK(detail::guided_direction(point, Freedom::curve, 0, x, 1e-3).isZero(0.0));
}
