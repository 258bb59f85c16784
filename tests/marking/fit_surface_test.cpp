#include "support/catch.hpp"

#include <pavior/marking/fit_surface.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

struct Sample {
    std::vector<Facet> facets;
    std::vector<Vec3> points;
};

/// Triangles of a grid over [0, 1]^2, with the normal of each.
template <class Map>
Sample sample(int n, const Map& map) {
    Sample s;
    const auto at = [&](int i, int j) { return Vec3(map(double(i) / n, double(j) / n)); };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 normal = (b - a).cross(c - a);
        s.facets.push_back({(a + b + c) / 3, normal.normalized(), 0.5 * normal.norm()});
    };
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            s.points.push_back(at(i, j));
            if (i < n && j < n) {
                add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
    }
    return s;
}

const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 2).normalized()).toRotationMatrix();

}  // namespace

TEST_CASE("a plane is found, with its side") {
    const Sample s = sample(3, [](double u, double v) -> Vec3 { return turn * Vec3(u, 2 * v, 0.5); });
    const PatchSurface plane = fit_surface(s.facets, s.points, 1e-6);
    CHECK(plane.kind == SurfaceKind::plane);
    CHECK(plane.distance(turn * Vec3(0.2, -3, 1.5)) == Approx(1.0));
    CHECK((plane.normal(Vec3(0, 0, 0)) - turn * Vec3::UnitZ()).norm() < 1e-9);
}

TEST_CASE("a cylinder, a sphere and a cone are found and continue past their patch") {
    const Sample round =
        sample(12, [](double u, double v) -> Vec3 { return turn * Vec3(2 * std::cos(u), 2 * std::sin(u), 3 * v); });
    const PatchSurface cylinder = fit_surface(round.facets, round.points, 1e-5);
    CHECK(cylinder.kind == SurfaceKind::cylinder);
    CHECK(cylinder.radius == Approx(2.0).epsilon(1e-4));
    CHECK(cylinder.distance(turn * Vec3(-2.5, 0, 40)) == Approx(0.5).epsilon(1e-3));

    const Sample ball = sample(12, [](double u, double v) -> Vec3 {
        const double a = 1.5 * u;
        const double b = 1.5 * v - 0.7;
        return turn * Vec3(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
    });
    const PatchSurface sphere = fit_surface(ball.facets, ball.points, 1e-5);
    CHECK(sphere.kind == SurfaceKind::sphere);
    CHECK(sphere.distance(Vec3(0, 0, 0)) == Approx(-1.0).epsilon(1e-3));

    const Sample tip = sample(16, [](double u, double v) -> Vec3 {
        const double r = 1 + v;
        return turn * Vec3(r * std::cos(u), r * std::sin(u), 2 * r);
    });
    const PatchSurface cone = fit_surface(tip.facets, tip.points, 1e-5);
    CHECK(cone.kind == SurfaceKind::cone);
    CHECK(std::abs(cone.distance(turn * Vec3(-3, 0, 6))) < 1e-3);
}

TEST_CASE("what fits nothing is blended from its facets and is zero along a nearly flat patch") {
    const Sample s =
        sample(10, [](double u, double v) -> Vec3 { return Vec3(u, v, 0.05 * std::sin(7 * u) * std::cos(5 * v)); });
    const PatchSurface free = fit_surface(s.facets, s.points, 1e-6);
    CHECK(free.kind == SurfaceKind::facets);
    CHECK(std::abs(free.distance(Vec3(0.5, 0.5, 0.05 * std::sin(3.5) * std::cos(2.5)))) < 0.01);
    CHECK(free.distance(Vec3(0.5, 0.5, 1)) > 0.5);
    CHECK(free.distance(Vec3(0.5, 0.5, -1)) < -0.5);
}

TEST_CASE("two circles are on a cone, not on the sphere through them") {
    const auto band = [](int n, double top) {
        Sample s;
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int k, double r, double z) {
                const double a = 2 * std::numbers::pi * k / n;
                return Vec3(turn * Vec3(r * std::cos(a), r * std::sin(a), z));
            };
            const std::array<Vec3, 4> x{at(i, 1, 0), at(i + 1, 1, 0), at(i + 1, top, 1), at(i, top, 1)};
            for (const auto& [a, b, c] : {std::array{x[0], x[1], x[2]}, std::array{x[0], x[2], x[3]}}) {
                const Vec3 normal = (b - a).cross(c - a);
                if (normal.norm() > 1e-9) {
                    s.facets.push_back({(a + b + c) / 3, normal.normalized(), 0.5 * normal.norm()});
                }
            }
            s.points.insert(s.points.end(), x.begin(), x.end());
        }
        return s;
    };
    for (const double top : {0.0, 0.5}) {
        const Sample s = band(24, top);
        const PatchSurface cone = fit_surface(s.facets, s.points, 1e-5);
        CHECK(cone.kind == SurfaceKind::cone);
        CHECK(std::abs(cone.distance(turn * Vec3(0, 2 - top, -1))) < 1e-3);
    }
}
