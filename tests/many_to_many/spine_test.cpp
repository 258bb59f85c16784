#include <pavior/many_to_many/spine.hpp>

#include "support/catch.hpp"
#include "support/dice.hpp"

#include <cmath>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

struct Samples {
    std::vector<Vec3> points, tangents;
};

/// A helix of radius r that climbs by `rise` a radian.
Samples helix(double r, double rise, double angle, int n) {
    Samples result;
    for (int i = 0; i <= n; ++i) {
        const double a = angle * i / n;
        result.points.emplace_back(r * std::cos(a), r * std::sin(a), rise * a);
        result.tangents.push_back(Vec3(-r * std::sin(a), r * std::cos(a), rise).normalized());
    }
    return result;
}

Spine spine(const Samples& s, double per_radian = 0.0) {
    Spine result(per_radian);
    result.append(s.points, s.tangents);
    return result;
}

}  // namespace

TEST_CASE("coordinates along a curve in space can be undone, and have the derivative that they say") {
    const Spine map = spine(helix(3, 0.5, 4, 200));
    CHECK(map.height() == Approx(4 * std::hypot(3, 0.5)).epsilon(1e-9));
    Dice dice(7);
    for (int i = 0; i < 100; ++i) {
        const Vec3 q(dice.real(-1, 1), dice.real(-1, 1), dice.real(-2, map.height() + 2));
        const Vec3 p = map.rolled(q);
        CHECK((map.unrolled(p) - q).norm() < 1e-11);
        const Vec3 d(dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1));
        const double h = 1e-6;
        CHECK((map.unrolled(p, d) - (map.unrolled(p + h * d) - map.unrolled(p - h * d)) / (2 * h)).norm() < 1e-4);
        const Vec3 up = (map.rolled(q + h * Vec3::UnitZ()) - map.rolled(q - h * Vec3::UnitZ())) / (2 * h);
        CHECK(map.stretch(p) == Approx(up.norm()).epsilon(1e-3));
        // the frame does not turn: what keeps u and v runs along the curve
        CHECK(up.cross(map.rolled({0, 0, q[2] + h}) - map.rolled({0, 0, q[2] - h})).norm() < 1e-4 * 2 * h * up.norm());
    }
    Eigen::Matrix3d image;
    for (int k = 0; k < 3; ++k) {
        image.col(k) = map.unrolled(map.rolled({0.2, 0.1, 3}), Vec3::Unit(k));
    }
    CHECK(image.determinant() > 0);  // right-handed to right-handed
}

TEST_CASE("a curve is met to the fourth order of the distance of its samples") {
    const auto error = [](int n) {
        const Spine map = spine(helix(2, 0.7, 3, n));
        const Vec3 q = map.unrolled(Vec3(2 * std::cos(1.234), 2 * std::sin(1.234), 0.7 * 1.234));
        return std::hypot(q[0], q[1]);
    };
    CHECK(error(40) < 1e-6);
    CHECK(error(200) < 3e-9);
}

TEST_CASE("a curve goes on in parallel, and straight beyond its ends") {
    const Samples s = helix(2, 0, 1.5, 100);
    const Spine map = spine(s);
    const Spine aside = map.parallel(0.3, -0.2);
    CHECK((aside.rolled({0, 0, 0}) - map.rolled({0.3, -0.2, 0})).norm() < 1e-14);
    CHECK((aside.rolled({0, 0, aside.height()}) - map.rolled({0.3, -0.2, map.height()})).norm() < 1e-12);
    CHECK((map.rolled({0, 0, -1}) - (s.points.front() - s.tangents.front())).norm() < 1e-14);
    CHECK((map.unrolled(s.points.back() + 2 * s.tangents.back()) - Vec3(0, 0, map.height() + 2)).norm() < 1e-12);
    // the circle's second half, given on another radius, goes on where the first ends
    Samples half = helix(2.5, 0, 1.5, 100);
    const Eigen::AngleAxisd turn(1.5, Vec3::UnitZ());
    for (std::size_t i = 0; i < half.points.size(); ++i) {
        half.points[i] = turn * half.points[i];
        half.tangents[i] = turn * half.tangents[i];
    }
    Spine joined = map;
    joined.append(half.points, half.tangents);
    CHECK(joined.height() == Approx(6).epsilon(1e-9));
    CHECK((joined.rolled({0, 0, 6}) - Vec3(2 * std::cos(3), 2 * std::sin(3), 0)).norm() < 1e-6);
}

TEST_CASE("sharp turns get more height, centres of curvature no stretch") {
    const Spine map = spine(helix(0.5, 0, 2, 100), 3.0);
    CHECK(map.height() == Approx(6).epsilon(1e-9));
    CHECK((map.unrolled(map.rolled({0.1, 0.2, 4})) - Vec3(0.1, 0.2, 4)).norm() < 1e-11);
    CHECK(map.stretch({0.25 * std::cos(1), 0.25 * std::sin(1), 0}) == Approx(0.5).epsilon(1e-4));
    CHECK(std::abs(map.stretch({1e-3 * std::cos(1), 1e-3 * std::sin(1), 0})) < 0.01);
}
